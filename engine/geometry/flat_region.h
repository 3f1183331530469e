#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack {

/// A planar triangle mesh; triangles are counter-clockwise.
struct FlatMesh {
    std::vector<Eigen::Vector2d> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Triangulates the region inside the outline (even-odd rule) and outside all holes, by constrained
/// Delaunay triangulation of all edges. Holes may cross the outline and each other, lie outside or
/// be empty; intersections become vertices. An outline of fewer than three corners encloses
/// nothing.
FlatMesh triangulateRegion(const std::vector<Eigen::Vector2d>& outline,
                           const std::vector<std::vector<Eigen::Vector2d>>& holes);

}  // namespace dollytrack
