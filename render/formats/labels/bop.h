#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// BOP: the dataset's folder is a scene; poses and visibility of things, and their masks.
extern const Format kBopFormat;

}  // namespace dollytrack::render
