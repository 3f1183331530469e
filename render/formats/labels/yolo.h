#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// YOLO: one line of normalised numbers per target; boxes in labels/, polygons in labels_seg/.
extern const Format kYoloFormat;

/// Links to the images in a folder beside the labels, for example images/000000.png.
[[nodiscard]] PictureLinks yoloPictures(const DatasetContents& contents);

}  // namespace dollytrack::render
