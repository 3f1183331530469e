#pragma once

#include "engine/core/result.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack::gazebo {

/// Reads the visuals of a world or model of Gazebo (SDF 1.4 and later). Links that are connected by
/// joints are one object; every other link is an object of its own. z up, metres. Errors: BadInput,
/// Cancelled.
Result<RawScene> readSdf(const std::filesystem::path& path, const ImportOptions& options,
                         const JobContext& job);

}  // namespace dollytrack::gazebo
