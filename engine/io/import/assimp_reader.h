#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_source.h"
#include "engine/io/import/raw_scene.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack {

/// Reads OBJ, FBX, glTF/GLB, DAE, PLY or STL through assimp. The one place that calls it: a
/// malformed file can bring assimp down, so this is what a sandbox will wrap.
Result<RawScene> readWithAssimp(const std::filesystem::path& path, const JobContext& job);

/// The same for a model inside an archive or folder: what it names (materials, buffers) is looked
/// up beside it in the same files, and nowhere else; its pictures come embedded.
Result<RawScene> readWithAssimp(const FileSource& files, const std::string& name,
                                const JobContext& job);

}  // namespace dollytrack
