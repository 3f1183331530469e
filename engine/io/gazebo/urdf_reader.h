#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/sandbox/reachable_files.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack::gazebo {

/// Reads a URDF file, its joints at zero: z up, metres. A link is an object, together with the
/// links that movable joints hang on it and what is fixed to those. Joints that name links which do
/// not exist are warned of with their line. Errors: BadInput, with the line; Cancelled.
Result<RawScene> readUrdf(const std::filesystem::path& path, const ImportOptions& options,
                          const JobContext& job);

/// The same as a model to be placed in other scenes, whose files lie below `files`.
Result<RawScene> readUrdfModel(const std::filesystem::path& path, const io::ReachableFiles& files,
                               const JobContext& job);

}  // namespace dollytrack::gazebo
