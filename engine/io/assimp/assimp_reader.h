#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_source.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack {

/// Reads OBJ, FBX, DAE or STL through assimp; the one place that calls it. See readModel().
[[nodiscard]] Result<RawScene> readWithAssimp(const std::filesystem::path& path,
                                              const JobContext& job);

/// The same for a model inside an archive or folder: what it names is looked up beside it in the
/// same files, and nowhere else.
[[nodiscard]] Result<RawScene> readWithAssimp(const FileSource& files, const std::string& name,
                                              const JobContext& job);

}  // namespace dollytrack
