#pragma once

#include "engine/math/pose.h"
#include "engine/plan/camera_path.h"

#include <functional>

namespace dollytrack::planning {

class ViewEstimator;
struct PitchBand;

/// Sets Key::image_motion_rad of each key but the first: image motion since the key before, rad. It
/// is the turning angle plus the camera's displacement divided by the median depth of the view;
/// displacement along the viewing direction counts half. Call again after inserting keys.
void measureImageMotion(SmoothPath& path,
                        const std::function<Pose(const SmoothPath::Key&)>& pose_at,
                        const ViewEstimator& views, const PitchBand& pitch);

}  // namespace dollytrack::planning
