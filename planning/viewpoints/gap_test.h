#pragma once

#include <Eigen/Core>

namespace dollytrack::planning {

class SweptSphere;
class ViewEstimator;

/// Surfaces farther from a place than this make no gap of it, m.
[[nodiscard]] double gapReach(double camera_radius_m);

/// Whether a place lies in a gap, such as that between a cupboard and the wall, under a bed or in a
/// shelf: a third of all lines through it end on both sides, within gapReach(), on surfaces that
/// face each other. In the corner of a room surfaces do not.
[[nodiscard]] bool isInGap(const SweptSphere& sphere, const ViewEstimator& views,
                           const Eigen::Vector3d& place);

}  // namespace dollytrack::planning
