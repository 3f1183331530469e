#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// KITTI's object detection: label_2/, a line an object seen.
extern const Format kKittiObjectsFormat;

}  // namespace dollytrack::render
