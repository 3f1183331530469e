#pragma once

#include "engine/io/import/raw_scene.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <span>

namespace dollytrack {

/// A mesh as a file gives it: nothing checked yet.
struct SourceMesh {
    std::span<const Eigen::Vector3f> positions;
    std::span<const Eigen::Vector3f> normals;  // empty, or one per position
    std::span<const Eigen::Vector3f> uvs;      // empty, or one per position; z unused
    std::span<const std::uint32_t> face_sizes;
    std::span<const std::uint32_t> face_indices;
};

/// Fills positions, normals, uvs, triangles, bounds and areas of `part`: polygons are cut into
/// triangles, broken faces dropped and counted, missing normals made (smooth where faces meet at
/// less than 45 degrees), equal vertices joined, everything moved by `source_from_mesh`.
RepairCounts buildMeshPart(const SourceMesh& mesh, const Eigen::Affine3d& source_from_mesh,
                           MeshPart& part);

/// Measures bounds and areas from positions and triangles, whatever they were.
void measurePart(MeshPart& part);

}  // namespace dollytrack
