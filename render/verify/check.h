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

/// A row of the table of checks.
struct Check {
    const char* name;
    const char* text;                     // property that a valid dataset has, for users
    std::span<const char* const> needs;   // required modalities and formats
    std::span<const char* const> one_of;  // at least one of these is required, if any are listed
    bool needs_scene;
    /// Reads the required files that are not images and returns the check's functions. `subject`
    /// outlives them.
    CheckWork (*begin)(const Subject& subject, Findings& findings);
};

std::span<const Check> checks();

}  // namespace dollytrack::verify
