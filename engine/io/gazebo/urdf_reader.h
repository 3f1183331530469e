#pragma once

#include "engine/core/result.h"
#include "engine/io/files/reachable_files.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack::gazebo {

/// Reads the visuals of a URDF file with all joints at zero. z up, metres. An object is a link
/// together with the links that movable joints attach to it and the links fixed to those. Joints
/// that name missing links become warnings. Errors: BadInput, with the line; Cancelled.
Result<RawScene> readUrdf(const std::filesystem::path& path, const ImportOptions& options,
                          const JobContext& job);

/// The same for a model to be placed in another scene; meshes are searched for below `files`.
Result<RawScene> readUrdfModel(const std::filesystem::path& path, const ReachableFiles& files,
                               const JobContext& job);

}  // namespace dollytrack::gazebo
