#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// KITTI object detection: label_2/, one line per visible object.
extern const Format kKittiObjectsFormat;

}  // namespace dollytrack::render
