#pragma once

#include "render/formats/formats.h"
#include "render/formats/media/picture_links.h"

namespace dollytrack::render {

/// YOLO: a line of normalised numbers a target, boxes in labels/ and outlines in labels_seg/.
extern const Format kYoloFormat;

/// Pictures in a folder beside the labels', images/000000.png.
[[nodiscard]] PictureLinks yoloPictures(const DatasetContents& contents);

}  // namespace dollytrack::render
