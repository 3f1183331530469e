#pragma once

#include "render/formats/formats.h"
#include "render/formats/media/picture_links.h"

namespace dollytrack::render {

/// YOLO: one line of normalised numbers per target; boxes in labels/, polygons in labels_seg/.
extern const Format kYoloFormat;

/// Links to the images in a folder beside the labels, for example images/000000.png.
[[nodiscard]] PictureLinks yoloPictures(const DatasetContents& contents);

}  // namespace dollytrack::render
