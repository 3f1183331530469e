#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// TUM RGB-D: groundtruth.txt, picture lists and associations. The dataset folder is the sequence
/// folder.
extern const Format kTumFormat;

}  // namespace dollytrack::render
