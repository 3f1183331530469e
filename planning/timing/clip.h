#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"

#include <string>
#include <string_view>

namespace dollytrack::planning {

struct PlanParams;
struct TimingParams;

/// Whether the frame rate is fixed, by keep_frame_rate, duration_s or motion_preset=slam, so that
/// budgets must not lower it.
[[nodiscard]] bool keepsFrameRate(const TimingParams& params);

/// Limit of the image motion, rad/s, from max_image_motion_dps or the preset; 0: no limit.
[[nodiscard]] double imageMotionLimit_rps(const TimingParams& params);

/// Number of frames of a trajectory with fixed frame rate: exactly that many with `duration_s`, at
/// most that many with `max_frames`; 0: no limit, or the frame rate is not fixed.
[[nodiscard]] int clipFrames(const TimingParams& params);

/// Error: Usage, if the length of a clip contradicts other parameters or is too long.
[[nodiscard]] Status validateClip(const PlanParams& params);

/// Error: Failed, for a clip too short for the views that must be visited.
[[nodiscard]] tl::unexpected<Error> tooShortClip(const TimingParams& params);

/// Mean number of frames per second; jumps from one path to the next do not count as time.
[[nodiscard]] double meanFrameRate(const Trajectory& trajectory);

/// The parameter because of which frames were left out, max_frames or max_repeat_rate; empty if
/// none was.
[[nodiscard]] std::string_view whyFramesWereLeftOut(const Trajectory& trajectory,
                                                    const TimingParams& params);

/// A phrase saying that a budget left out frames and which option keeps them, or that a fixed frame
/// rate or a trajectory of one frame left more than half of the budget unused; else empty.
[[nodiscard]] std::string frameRateNote(const Trajectory& trajectory, const TimingParams& params);

}  // namespace dollytrack::planning
