#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// TartanAir: poses in a north-east-down world, images, and NumPy files of depth, classes and flow.
extern const Format kTartanAirFormat;

}  // namespace dollytrack::render
