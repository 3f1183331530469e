#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack {

/// Whether a file is a scene that only the program that made it can read, and that program can
/// convert it: a Blender file, by its name.
[[nodiscard]] bool needsConversion(const std::filesystem::path& scene);

/// Converts a Blender file to glTF with the installed Blender and returns the new file beside it,
/// `room.blend.glb`. If that exists and is newer than the Blender file, it is returned as it is.
/// Blender does not run scripts of the file, reads only the file's folder, writes only a temporary
/// folder in it, and has no network. Errors: BadInput if Blender is not installed or cannot read
/// the file; CannotWrite for the folder; Failed if the system cannot confine Blender, or after 30
/// minutes; Cancelled.
[[nodiscard]] Result<std::filesystem::path> convertScene(const std::filesystem::path& scene,
                                                         const JobContext& job);

}  // namespace dollytrack
