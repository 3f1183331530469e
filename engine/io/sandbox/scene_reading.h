#pragma once

#include "engine/core/result.h"
#include "engine/io/format_table/scene_format.h"
#include "engine/io/sandbox/scene_serialization.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string>

namespace dollytrack {

/// A scene file's content and digest.
struct SceneFileContent {
    DecodedScene scene;
    std::string sha256;  // of the scene file
};

/// Reads a scene file of this format: in a separate process (importer_process.h), from the cache
/// (scene_cache.h) or in this process, as the options say. The result is always checked.
[[nodiscard]] Result<SceneFileContent> readSceneFile(const SceneFormat& format,
                                                     const std::filesystem::path& path,
                                                     const ImportOptions& options,
                                                     const JobContext& job);

}  // namespace dollytrack
