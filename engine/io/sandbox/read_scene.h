#pragma once

#include "engine/core/result.h"
#include "engine/io/import/scene_format.h"
#include "engine/io/sandbox/scene_frame.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack::io {

/// The file by its format's reader, and the pictures that it asks for where the options want them.
/// Nothing is checked yet.
[[nodiscard]] Result<ReadScene> readScene(const SceneFormat& format,
                                          const std::filesystem::path& path,
                                          const ImportOptions& options, const JobContext& job);

}  // namespace dollytrack::io
