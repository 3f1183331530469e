#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/scene_import.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack::gazebo {

/// Reads a world or model of Gazebo (SDF 1.4 and later), the visuals of its links. A model with one
/// link, or whose links joints hold together, is one object; other links are objects of their own.
/// z up, metres. Errors: BadInput, Cancelled.
Result<RawScene> readSdf(const std::filesystem::path& path, const ImportOptions& options,
                         const JobContext& job);

}  // namespace dollytrack::gazebo
