#pragma once

#include "engine/core/result.h"
#include "engine/io/format_table/scene_format.h"
#include "engine/io/sandbox/scene_serialization.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack {

/// Reads a file by its format's reader, and decodes the textures that it refers to if the options
/// ask for them. The result is unchecked.
[[nodiscard]] Result<DecodedScene> readScene(const SceneFormat& format,
                                             const std::filesystem::path& path,
                                             const ImportOptions& options, const JobContext& job);

}  // namespace dollytrack
