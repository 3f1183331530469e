#pragma once

#include "engine/core/result.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string_view>

namespace dollytrack {

/// Whether a text file that begins with `head` may be a SceneNet RGB-D scene.
bool likeSceneNet(std::string_view head);

/// Reads a scene of SceneNet RGB-D (McCormac et al., ICCV 2017): a layout with ShapeNet models,
/// which are searched for below the model folders. Right-handed, y up, metres. Errors: BadInput,
/// Cancelled.
Result<RawScene> readSceneNetScene(const std::filesystem::path& path, const ImportOptions& options,
                                   const JobContext& job);

/// Files and folders that readSceneNetScene() opens in addition to the scene's folder.
std::vector<std::filesystem::path> sceneNetInputs(const std::filesystem::path& path,
                                                  const ImportOptions& options);

}  // namespace dollytrack
