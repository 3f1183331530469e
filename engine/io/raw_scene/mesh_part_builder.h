#pragma once

#include "engine/io/raw_scene/raw_scene.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <span>

namespace dollytrack {

/// An unchecked mesh of a file.
struct SourceMesh {
    std::span<const Eigen::Vector3f> positions;
    std::span<const Eigen::Vector3f> normals;  // empty, or one per position
    std::span<const Eigen::Vector3f> uvs;      // empty, or one per position; z unused
    std::span<const std::uint32_t> face_sizes;
    std::span<const std::uint32_t> face_indices;
};

/// Fills positions, normals, uvs, triangles, bounds and areas of `part`, transformed by
/// `source_from_mesh`. Polygons are triangulated, invalid faces dropped, missing normals computed
/// (smooth at edges below 45 degrees) and equal vertices joined. Returns the number of repairs.
RepairCounts buildMeshPart(const SourceMesh& mesh, const Eigen::Affine3d& source_from_mesh,
                           MeshPart& part);

/// Recomputes bounds and areas from positions and triangles.
void measurePart(MeshPart& part);

}  // namespace dollytrack
