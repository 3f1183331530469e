#pragma once

#include "planning/timing/motion_limits.h"
#include "planning/timing/turn.h"

namespace dollytrack::planning {

/// Timing of a turn from rest to rest with a trapezoidal rate: constant acceleration, constant
/// rate, constant deceleration.
class TurnProfile {
  public:
    TurnProfile() = default;
    TurnProfile(const Turn& turn, const MotionLimits& limits);

    /// The shortest time that the limits allow, s.
    [[nodiscard]] double time() const { return time_s_; }

    /// Angle turned, rad, at a share 0..1 of the time. A turn that takes longer is slower
    /// throughout.
    [[nodiscard]] double turnedAt(double share) const;

  private:
    double angle_ = 0.0;
    double acceleration_ = 0.0;
    double ramp_s_ = 0.0;
    double time_s_ = 0.0;
};

}  // namespace dollytrack::planning
