#pragma once

#include "engine/math/pose.h"
#include "engine/plan/camera_path.h"

#include <functional>

namespace dollytrack::planning {

struct GazeParams;
struct Surroundings;
struct TimingParams;

/// Adds views between the key frames of a smoothed path, in which the camera looks at many objects
/// at once instead of turning straight from one close view to the next. The places are those that
/// the camera passes anyway. Among all sequences of directions, dynamic programming finds the one
/// that shows the most in relation to the time it takes (a fractional program; Dinkelbach 1967,
/// "On nonlinear fractional programming"); an object counts less the more often it is shown.
/// Key frames stay as they are; `pose_at` tells their poses.
[[nodiscard]] SmoothPath withContextViews(
    const SmoothPath& path, const std::function<Pose(const SmoothPath::Key&)>& pose_at,
    const Surroundings& around, const GazeParams& params, const TimingParams& timing);

}  // namespace dollytrack::planning
