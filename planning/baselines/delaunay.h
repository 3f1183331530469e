#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace dollytrack::planning {

/// Delaunay triangulation of points in a plane (Bowyer 1981, Watson 1981). Returns triangles as
/// indices into `points`, counter-clockwise; empty for fewer than three points. Points that
/// coincide with an earlier one are skipped. Quadratic in the number of points; meant for a few
/// hundred.
std::vector<std::array<int, 3>> delaunay(const std::vector<Eigen::Vector2d>& points);

}  // namespace dollytrack::planning
