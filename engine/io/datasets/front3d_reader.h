#pragma once

#include "engine/core/result.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string_view>

namespace dollytrack {

/// Whether a file that begins with `head` may be a 3D-FRONT scene.
bool likeFront3d(std::string_view head);

/// Reads a house of 3D-FRONT (2021): a JSON file with the architecture and the placement of
/// 3D-FUTURE's models. Right-handed, y up, metres. Errors: BadInput, Cancelled.
Result<RawScene> readFront3dScene(const std::filesystem::path& path, const ImportOptions& options,
                                  const JobContext& job);

/// Files and folders that readFront3dScene() opens in addition to the scene's folder.
std::vector<std::filesystem::path> front3dInputs(const std::filesystem::path& path,
                                                 const ImportOptions& options);

}  // namespace dollytrack
