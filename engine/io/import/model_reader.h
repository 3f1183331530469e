#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_source.h"
#include "engine/io/import/raw_scene.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string>

namespace dollytrack {

/// Reads a model by its extension: glTF and GLB by io/gltf, PLY by ply_mesh.h, OBJ, FBX, DAE and
/// STL by assimp.
/// Either runs in the locked-up importer only: a malformed file can bring libraries down.
[[nodiscard]] Result<RawScene> readModel(const std::filesystem::path& path, const JobContext& job);

/// The same for a model inside an archive or folder: what it names (materials, buffers) is looked
/// up beside it in the same files, and nowhere else; its pictures come embedded.
[[nodiscard]] Result<RawScene> readModel(const FileSource& files, const std::string& name,
                                         const JobContext& job);

}  // namespace dollytrack
