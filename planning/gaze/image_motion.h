#pragma once

#include "engine/math/pose.h"
#include "engine/plan/camera_path.h"

#include <functional>

namespace dollytrack::planning {

class ViewEstimator;
struct PitchBand;

/// Sets Key::image_motion_rad of each key: how far the image moves on the way from the key before,
/// as the angle turned by plus the way across the direction of view over the distance of what is
/// seen (the median of few rays).
void measureImageMotion(SmoothPath& path,
                        const std::function<Pose(const SmoothPath::Key&)>& pose_at,
                        const ViewEstimator& views, const PitchBand& pitch);

}  // namespace dollytrack::planning
