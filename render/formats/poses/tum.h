#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// TUM RGB-D: groundtruth.txt, the lists of pictures, and their associations. The dataset's folder
/// is the sequence's.
extern const Format kTumFormat;

}  // namespace dollytrack::render
