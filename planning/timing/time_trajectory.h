#pragma once

#include "engine/core/result.h"
#include "engine/plan/plan.h"
#include "planning/visibility/heading_limit.h"
#include "planning/visibility/pitch_band.h"

#include <cstddef>
#include <vector>

namespace dollytrack::planning {

struct TimingParams;

/// Puts frames on the smoothed paths at a fixed rate under the limits of motion (motionLimits()),
/// one of them exactly on each key frame: the time from key to key is about the least the limits
/// allow, rounded up to whole frames. Speed is continuous; the camera stands still at both ends of
/// a path and where it turns a corner on the spot, and slows down in tight curves. From key to key
/// it turns from rest to rest, roll-free; pinned points keep their pose to the last bit. No
/// frame looks steeper than the band allows, turns included. With
/// `max_frames` the rate is lowered until the budget holds, down to one frame a key. Error: Failed
/// when there are more keys than frames allowed. Under a heading limit the camera looks along its
/// motion (see withHeadingKeys()), and each turn on the spot needs frames as well.
Result<Trajectory> timeTrajectory(const std::vector<SmoothPath>& paths,
                                  const std::vector<PositionPoint>& position_points,
                                  const std::vector<ObservationPoint>& observation_points,
                                  const TimingParams& params, const PitchBand& pitch = {},
                                  const HeadingLimit& heading = {});

/// The fewest frames that these paths can be timed with.
[[nodiscard]] std::size_t leastFrames(const std::vector<SmoothPath>& paths,
                                      const std::vector<PositionPoint>& position_points,
                                      const std::vector<ObservationPoint>& observation_points,
                                      const PitchBand& pitch, const HeadingLimit& heading);

}  // namespace dollytrack::planning
