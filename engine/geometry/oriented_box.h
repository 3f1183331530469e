#pragma once

#include "engine/scene/object.h"

#include <Eigen/Core>

#include <span>

namespace dollytrack {

/// The upright box of least floor area around the points. Its yaw is within ±45°, and exactly 0
/// when the axis-aligned box is as good to within `snap_share` of its area.
OrientedBox fitUprightBox(std::span<const Eigen::Vector3f> points, double snap_share = 0.005);

}  // namespace dollytrack
