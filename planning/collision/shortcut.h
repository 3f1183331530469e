#pragma once

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

class SweptSphere;

/// Removes corners of a path from start to goal that straight collision-free moves can skip,
/// greedily from the start. Start and goal are not part of `corners` or of the result.
std::vector<Eigen::Vector3d> shortened(const std::vector<Eigen::Vector3d>& corners,
                                       const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                                       const SweptSphere& sphere);

/// Length of the polyline start, corners, goal, m.
double wayLength(const std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& start,
                 const Eigen::Vector3d& goal);

}  // namespace dollytrack::planning
