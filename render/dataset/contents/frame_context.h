#pragma once

#include "render/dataset/contents/dataset_contents.h"
#include "render/scene/moving_objects.h"
#include "render/sensors/sensor_lens.h"

namespace dollytrack::render {

/// Everything besides its record that a frame's files are made from. Shared by all frames and read
/// by many threads.
struct FrameContext {
    const DatasetContents& contents;
    const MovingObjects& moving;
    const SensorLens* sensor_lens = nullptr;  // only with the modality rgb_sensor
};

}  // namespace dollytrack::render
