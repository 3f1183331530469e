#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/semantics/label_files.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack::semantics {

/// Reads a mesh whose faces carry numbers or colours of objects: each object of the files becomes
/// one of the scene, and what they leave unlabelled one that is no target. Where the room's colours
/// are in another mesh, that mesh is shown, and its triangles take the label of the nearest
/// labelled surface. Errors: BadInput, Cancelled.
[[nodiscard]] Result<RawScene> readLabelled(const LabelledFiles& files, const JobContext& job);

/// Reads a PLY mesh that has no such files: by the object and class numbers of its own faces and
/// vertices if it has some. Errors: BadInput, Cancelled.
[[nodiscard]] Result<RawScene> readPly(const std::filesystem::path& path, const JobContext& job);

}  // namespace dollytrack::semantics
