#pragma once

#include "engine/math/pose.h"
#include "engine/plan/camera_path.h"
#include "planning/visibility/heading_limit.h"

#include <functional>

namespace dollytrack::planning {

/// The path with more keys, which turn the camera along its motion: at the ends of each curve, and
/// where it turns a corner or aside to a key frame, on the spot. From key to key the camera then
/// turns the shorter way between two views that the limit allows all along, so that all views
/// between them are allowed, too. The path is one that was smoothed under this limit.
[[nodiscard]] SmoothPath withHeadingKeys(const SmoothPath& path,
                                         const std::function<Pose(const SmoothPath::Key&)>& pose_at,
                                         const HeadingLimit& limit);

}  // namespace dollytrack::planning
