#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// TUM RGB-D: groundtruth.txt, image lists and associations. The dataset folder is the sequence
/// folder.
extern const Format kTumFormat;

}  // namespace dollytrack::render
