#pragma once

#include "engine/core/result.h"
#include "engine/io/models/ply_mesh.h"
#include "engine/io/semantics/label_files.h"
#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>

namespace dollytrack::semantics {

/// Packs an sRGB colour of 0..1 as 0xRRGGBB. Returns 0xFFFFFFFF for non-finite values.
[[nodiscard]] std::uint32_t packedColor(const Eigen::Vector3f& color);

/// Reads a semantic glTF file (HM3D) as a mesh with an object number per triangle, by the colour of
/// its texture or, without one, of its vertices; -1 for colours that `names` does not contain.
/// Errors: BadInput, Cancelled.
[[nodiscard]] Result<PlyMesh> readColoredMesh(const std::filesystem::path& path,
                                              const LabelNames& names, const JobContext& job);

}  // namespace dollytrack::semantics
