#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack {

/// Whether a file is a Blender scene, by its name.
[[nodiscard]] bool isBlenderFile(const std::filesystem::path& scene);

/// Converts a Blender file to glTF with the installed Blender and returns the new file beside it,
/// `room.blend.glb`. If that exists and was made from the file as it is, it is returned at once.
/// Blender does not run scripts of the file, reads only the file's folder, writes only a temporary
/// folder beside it, and has no network. Objects that are hidden in renders are left out; files
/// that it cannot read are warned of. Errors: BadInput if Blender is not installed or cannot read
/// the file; CannotWrite for the folder; Failed if the system cannot confine Blender, or after 30
/// minutes; Cancelled.
[[nodiscard]] Result<std::filesystem::path> convertScene(const std::filesystem::path& scene,
                                                         const JobContext& job);

}  // namespace dollytrack
