#pragma once

#include "engine/core/result.h"
#include "engine/plan/plan.h"
#include "planning/visibility/heading_limit.h"
#include "planning/visibility/pitch_band.h"

#include <vector>

namespace dollytrack::planning {

struct TimingParams;

/// Times smoothed paths: places frames at a fixed rate under the limits of motion (motionLimits()),
/// one exactly at each key. The time between keys is close to the least that the limits allow,
/// rounded up to whole frames, and longer where max_image_motion_dps asks for it.
/// Speed is continuous; the camera stands still at both ends of a path and at corners without a
/// curve. Between keys it turns roll-free, from rest to rest, within the pitch band. Fixed points
/// keep their exact pose. With `max_frames` the motion stays the same, and frames between keys are
/// left out, fewer of them where Key::frame_weight is large, down to one frame per key. With
/// `duration_s` the motion is slowed to fill the clip exactly. Under a heading limit the camera
/// looks along its motion (see withHeadingKeys()), and turns on the spot need frames as well.
/// Errors: Failed if there are more keys than `max_frames`; Usage if the motion takes more than a
/// million frames and `max_frames` is not set. If it is set, the frame interval is lengthened.
Result<Trajectory> timeTrajectory(const std::vector<SmoothPath>& paths,
                                  const std::vector<PositionPoint>& position_points,
                                  const std::vector<ObservationPoint>& observation_points,
                                  const TimingParams& params, const PitchBand& pitch = {},
                                  const HeadingLimit& heading = {});

}  // namespace dollytrack::planning
