#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "render/verify/compare/finding.h"
#include "render/verify/read/frame_images.h"
#include "render/verify/read/stored_dataset.h"

#include <functional>

namespace dollytrack::verify {

/// Input of the checks.
struct Subject {
    const StoredDataset& dataset;
    const Scene* scene = nullptr;     // scene of the dataset; null if unavailable
    const RayCaster* rays = nullptr;  // ray caster of the scene without object motion
};

/// Functions of one check. Both may be empty.
struct CheckWork {
    /// Checks one frame. Called from many threads, each with a different frame.
    std::function<void(FrameImages& images, Findings& findings)> frame;
    /// Called once after all frames. Returns early if the job is cancelled.
    std::function<void(Findings& findings, const JobContext& job)> finish;
};

}  // namespace dollytrack::verify
