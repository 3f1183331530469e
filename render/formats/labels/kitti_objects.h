#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// KITTI object detection: label_2/, one line per visible object.
extern const Format kKittiObjectsFormat;

}  // namespace dollytrack::render
