#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack {

/// Triangles in a plane, counter-clockwise.
struct FlatMesh {
    std::vector<Eigen::Vector2d> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// What an outline encloses (even-odd) and no hole does: constrained Delaunay over all edges.
/// Holes may cross the outline and each other, lie outside, or be empty; crossings become corners
/// of their own. Outlines of fewer than three corners enclose nothing.
FlatMesh triangulateRegion(const std::vector<Eigen::Vector2d>& outline,
                           const std::vector<std::vector<Eigen::Vector2d>>& holes);

}  // namespace dollytrack
