#pragma once

namespace dollytrack::planning {

struct TimingParams;

/// Limits of the camera's motion, in radians; the parameters use degrees.
struct MotionLimits {
    double speed_mps = 0.0;
    double acceleration_mps2 = 0.0;  // of the acceleration vector: along the path and across it
                                     // together
    double turn_rps = 0.0;
    double turn_acceleration_rps2 = 0.0;
};

/// The preset's limits, replaced by each limit that is set (above 0) in the parameters. `custom`
/// has no limits of its own.
[[nodiscard]] MotionLimits motionLimits(const TimingParams& params);

}  // namespace dollytrack::planning
