#pragma once

#include "engine/math/pose.h"
#include "engine/plan/camera_path.h"

#include <functional>

namespace dollytrack::planning {

struct GazeParams;
struct PlanningEnvironment;
struct TimingParams;

/// Inserts context views between the key frames of a smoothed path: the camera looks at many
/// objects at once instead of turning straight from one close view to the next. Path and key frames
/// stay unchanged; `pose_at` gives the poses of keys. Dynamic programming chooses one direction for
/// each position, maximizing the visible objects relative to the mean of the direct turns, minus
/// turning time. It runs in three passes; between them an object's weight falls with how often it
/// is shown. Under a budget of frames Key::slowdown grows with what is shown on the way to the key,
/// so that frames go where many objects are in view. With `environment.corners`, views with few
/// corners cost as much as turning far, and large turns have more positions, for ways round bare
/// walls. Returns the path unchanged if view_mix is 0 and corners do not count, if the heading is
/// restricted, or if the budget of frames leaves none for context.
[[nodiscard]] SmoothPath withContextViews(
    const SmoothPath& path, const std::function<Pose(const SmoothPath::Key&)>& pose_at,
    const PlanningEnvironment& environment, const GazeParams& params, const TimingParams& timing);

}  // namespace dollytrack::planning
