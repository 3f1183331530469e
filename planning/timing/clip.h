#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"

#include <string>

namespace dollytrack::planning {

struct PlanParams;
struct TimingParams;

/// Whether budgets must leave the frame rate alone: a clip of a given length or rate.
[[nodiscard]] bool keepsFrameRate(const TimingParams& params);

/// Whether a budget of frames is spread by how far the image moves; see max_image_motion_dps.
[[nodiscard]] bool limitsImageMotion(const TimingParams& params);

/// Frames that a trajectory at a kept frame rate may have: exactly so many with `duration_s`, at
/// most so many with `max_frames`; 0: any number.
[[nodiscard]] int clipFrames(const TimingParams& params);

/// Error: Usage, where the length of a clip contradicts other parameters.
[[nodiscard]] Status validateClip(const PlanParams& params);

/// Error: Failed, for a clip that is too short for what must be visited.
[[nodiscard]] tl::unexpected<Error> tooShortClip(const TimingParams& params);

/// A sentence saying that a budget lowered the frame rate and which option keeps it, or that a kept
/// frame rate left most of the frames unused; empty where neither happened.
[[nodiscard]] std::string frameRateNote(const Trajectory& trajectory, const TimingParams& params);

}  // namespace dollytrack::planning
