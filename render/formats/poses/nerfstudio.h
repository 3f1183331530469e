#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// nerfstudio: transforms.json.
extern const Format kNerfstudioFormat;

}  // namespace dollytrack::render
