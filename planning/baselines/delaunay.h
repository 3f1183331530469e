#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace dollytrack::planning {

/// Delaunay triangulation of points on a plane (Bowyer 1981, Watson 1981): no point lies inside the
/// circle through the corners of a triangle. Indices into `points`, counter-clockwise. Points that
/// coincide with an earlier one are left out. For some hundred points: time grows with their
/// square.
std::vector<std::array<int, 3>> delaunay(const std::vector<Eigen::Vector2d>& points);

}  // namespace dollytrack::planning
