#pragma once

#include "render/dataset_contents.h"
#include "render/moving_objects.h"

namespace dollytrack::render {

/// What a frame's files are made from beside its record. The same for all frames, and const: many
/// threads read it.
struct FrameContext {
    const DatasetContents& contents;
    const MovingObjects& moving;
};

}  // namespace dollytrack::render
