#pragma once

#include <Eigen/Core>

namespace dollytrack::planning {

class SweptSphere;
class ViewEstimator;

/// Longest line between two facing surfaces that still makes a gap, m.
[[nodiscard]] double gapReach(double camera_radius_m);

/// Whether a position is in a gap, for example between a cupboard and the wall, under a bed or in a
/// shelf: at least a third of the lines through it meet facing surfaces on both sides, no more than
/// gapReach() apart. In the corner of a room the surfaces do not face each other.
[[nodiscard]] bool isInGap(const SweptSphere& sphere, const ViewEstimator& views,
                           const Eigen::Vector3d& place);

}  // namespace dollytrack::planning
