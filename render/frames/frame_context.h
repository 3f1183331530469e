#pragma once

#include "render/dataset/dataset_contents.h"
#include "render/frames/moving_objects.h"
#include "render/sensors/sensor_lens.h"

namespace dollytrack::render {

/// What a frame's files are made from beside its record. The same for all frames, and const: many
/// threads read it.
struct FrameContext {
    const DatasetContents& contents;
    const MovingObjects& moving;
    const SensorLens* sensor_lens = nullptr;  // where rgb_sensor is wanted
};

}  // namespace dollytrack::render
