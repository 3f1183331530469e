#pragma once

#include "engine/math/pose.h"
#include "engine/plan/camera_path.h"
#include "planning/visibility/heading_limit.h"

#include <functional>

namespace dollytrack::planning {

/// Adds keys that turn the camera along its motion: at both ends of each curve, and on the spot at
/// corners and at key frames whose view is not allowed in passing. Between keys the camera then
/// turns the shorter way between two allowed views, so that all views are allowed. The path must
/// have been smoothed with the same limit. Returns it unchanged without a limit.
[[nodiscard]] SmoothPath withHeadingKeys(const SmoothPath& path,
                                         const std::function<Pose(const SmoothPath::Key&)>& pose_at,
                                         const HeadingLimit& limit);

}  // namespace dollytrack::planning
