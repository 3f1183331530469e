#pragma once

namespace dollytrack::planning {

struct TimingParams;

/// What the camera's motion may not exceed. Radians here, degrees in the parameters.
struct MotionLimits {
    double speed_mps = 0.0;
    double acceleration_mps2 = 0.0;  // along the path and across it together
    double turn_rps = 0.0;
    double turn_acceleration_rps2 = 0.0;
};

/// The preset's limits, but for those that have a parameter of their own set. `custom` has no
/// limits but these.
[[nodiscard]] MotionLimits motionLimits(const TimingParams& params);

}  // namespace dollytrack::planning
