#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "render/verify/finding.h"
#include "render/verify/read/frame_images.h"
#include "render/verify/read/stored_dataset.h"

#include <functional>
#include <span>

namespace dollytrack::verify {

/// What checks may look at.
struct Subject {
    const StoredDataset& dataset;
    const Scene* scene = nullptr;     // that the dataset was made of; null when it is not at hand
    const RayCaster* rays = nullptr;  // of the scene at rest
};

/// What a check does. Both may be empty.
struct CheckWork {
    /// Looks at one frame. Called from many threads, each with another frame.
    std::function<void(FrameImages& images, Findings& findings)> frame;
    /// Called once, after all frames. Returns early when the job is cancelled.
    std::function<void(Findings& findings, const JobContext& job)> finish;
};

/// A row of the one table of checks.
struct Check {
    const char* name;
    const char* text;                     // what is true of a sound dataset
    std::span<const char* const> needs;   // modalities and formats, all of them
    std::span<const char* const> one_of;  // and at least one of these, where there are any
    bool needs_scene;
    /// Reads what is needed of files that are not images. The subject outlives the work.
    CheckWork (*begin)(const Subject& subject, Findings& findings);
};

std::span<const Check> checks();

}  // namespace dollytrack::verify
