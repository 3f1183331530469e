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
/// is shown. Under a budget of frames Key::frame_weight grows with what is shown on the way to the
/// key, so that frames go where many objects are in view.
///
/// With `environment.corners` (trackability), views with few corners cost extra time, and large
/// turns get more positions, so that the camera can turn another way than past a bare wall; if
/// `may_start_elsewhere`, the path begins with a turn on the spot from a view of many corners.
///
/// Returns the path unchanged if neither view_mix nor trackability asks for context views, if the
/// heading is restricted, or if the budget of frames leaves none for them.
[[nodiscard]] SmoothPath withContextViews(
    const SmoothPath& path, const std::function<Pose(const SmoothPath::Key&)>& pose_at,
    const PlanningEnvironment& environment, const GazeParams& params, const TimingParams& timing,
    bool may_start_elsewhere = false);

}  // namespace dollytrack::planning
