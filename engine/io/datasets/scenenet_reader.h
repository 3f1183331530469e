#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/scene_import.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string_view>

namespace dollytrack::io {

/// Whether the first bytes of a text file may be a SceneNet RGB-D scene's.
bool likeSceneNet(std::string_view head);

/// A scene of SceneNet RGB-D (McCormac et al., ICCV 2017): a layout, and ShapeNet models put into
/// it, looked up below the folders of models. Right-handed, y up, metres. Errors: BadInput,
/// Cancelled.
Result<RawScene> readSceneNetScene(const std::filesystem::path& path, const ImportOptions& options,
                                   const JobContext& job);

/// What readSceneNetScene() opens besides the scene's own folder.
std::vector<std::filesystem::path> sceneNetInputs(const std::filesystem::path& path,
                                                  const ImportOptions& options);

}  // namespace dollytrack::io
