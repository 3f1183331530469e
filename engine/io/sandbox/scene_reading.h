#pragma once

#include "engine/core/result.h"
#include "engine/io/import/scene_format.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/sandbox/scene_frame.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string>

namespace dollytrack::io {

/// A scene file's content, and which bytes it had.
struct SceneReading {
    ReadScene scene;
    std::string sha256;  // of the scene file
};

/// Reads a scene file of this format: in a process of its own (importer_process.h), out of the
/// cache (scene_cache.h) or here, as the options say. What comes back is checked in any case.
[[nodiscard]] Result<SceneReading> readSceneFile(const SceneFormat& format,
                                                 const std::filesystem::path& path,
                                                 const ImportOptions& options,
                                                 const JobContext& job);

}  // namespace dollytrack::io
