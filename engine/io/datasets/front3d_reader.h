#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/scene_import.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string_view>

namespace dollytrack::io {

/// Whether the first bytes of a file may be a 3D-FRONT scene's.
bool likeFront3d(std::string_view head);

/// A house of 3D-FRONT (2021): one JSON file with the architecture, and where the models of
/// 3D-FUTURE stand. Right-handed, y up, metres. Errors: BadInput, Cancelled.
Result<RawScene> readFront3dScene(const std::filesystem::path& path, const ImportOptions& options,
                                  const JobContext& job);

/// What readFront3dScene() opens besides the scene's own folder.
std::vector<std::filesystem::path> front3dInputs(const std::filesystem::path& path,
                                                 const ImportOptions& options);

}  // namespace dollytrack::io
