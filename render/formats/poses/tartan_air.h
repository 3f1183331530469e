#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// TartanAir: poses in a north-east-down world, images, and NumPy files of depth, classes and flow.
extern const Format kTartanAirFormat;

}  // namespace dollytrack::render
