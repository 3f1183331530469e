#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// TartanAir: poses in the world north-east-down, images, and NumPy files of depth, classes and
/// flow.
extern const Format kTartanAirFormat;

}  // namespace dollytrack::render
