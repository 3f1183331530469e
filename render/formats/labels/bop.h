#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// BOP: the dataset folder is a BOP scene, with object poses, visibility and masks.
extern const Format kBopFormat;

}  // namespace dollytrack::render
