#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/sandbox/reachable_files.h"
#include "engine/io/import/scene_import.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace dollytrack::gazebo {

/// Whether the first bytes of an XML file may be a robot's.
bool likeUrdf(std::string_view head);

/// Reads a URDF file, each link an object, its joints at zero: z up, metres. Errors: BadInput,
/// Cancelled.
Result<RawScene> readUrdf(const std::filesystem::path& path, const ImportOptions& options,
                          const JobContext& job);

/// The same as a model to be placed in other scenes, whose files lie below `files`.
Result<RawScene> readUrdfModel(const std::filesystem::path& path, const io::ReachableFiles& files,
                               const JobContext& job);

/// What readUrdf() and readSdf() open besides the scene's own folder.
std::vector<std::filesystem::path> worldInputs(const std::filesystem::path& path,
                                               const ImportOptions& options);

}  // namespace dollytrack::gazebo
