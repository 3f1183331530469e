#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// YOLO: a line of normalised numbers a target, boxes in labels/ and outlines in labels_seg/.
extern const Format kYoloFormat;

}  // namespace dollytrack::render
