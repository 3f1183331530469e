#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// nerfstudio: transforms.json.
extern const Format kNerfstudioFormat;

}  // namespace dollytrack::render
