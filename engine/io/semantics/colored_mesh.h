#pragma once

#include "engine/core/result.h"
#include "engine/io/import/ply_mesh.h"
#include "engine/io/semantics/label_files.h"
#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>

namespace dollytrack::semantics {

/// 0xRRGGBB of an sRGB colour of 0 to 1; no colour of a table where it is no number.
[[nodiscard]] std::uint32_t packedColor(const Eigen::Vector3f& color);

/// A semantic glTF file (HM3D) as a mesh with numbers: the object of each triangle by the colours
/// of its picture, else by those of its vertices. Errors: BadInput, Cancelled.
[[nodiscard]] Result<PlyMesh> readColoredMesh(const std::filesystem::path& path,
                                              const LabelNames& names, const JobContext& job);

}  // namespace dollytrack::semantics
