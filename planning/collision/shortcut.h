#pragma once

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

class SweptSphere;

/// Leaves out corners of the way from start to goal that a straight collision-free move can skip.
std::vector<Eigen::Vector3d> shortened(const std::vector<Eigen::Vector3d>& corners,
                                       const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                                       const SweptSphere& sphere);

/// Length of start - corners - goal, m.
double wayLength(const std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& start,
                 const Eigen::Vector3d& goal);

}  // namespace dollytrack::planning
