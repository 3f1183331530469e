#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_source.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string>

namespace dollytrack {

/// Reads a model by its extension: glTF and GLB by io/gltf, PLY by ply_mesh.h, OBJ, FBX, DAE and
/// STL by assimp. Must run only in the sandboxed importer, since a malformed file can crash the
/// libraries. Errors: BadInput, Cancelled.
[[nodiscard]] Result<RawScene> readModel(const std::filesystem::path& path, const JobContext& job);

/// The same for a model inside an archive or folder. Files that it refers to (materials, buffers)
/// are searched for only beside it in the same source; its textures are embedded in the result.
[[nodiscard]] Result<RawScene> readModel(const FileSource& files, const std::string& name,
                                         const JobContext& job);

}  // namespace dollytrack
