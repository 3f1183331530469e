#pragma once

#include "planning/timing/motion_limits.h"
#include "planning/timing/turn.h"

namespace dollytrack::planning {

/// The pace of a turn that begins and ends at rest: speeds up evenly, goes on at one rate and slows
/// down evenly, so that angular velocity is continuous.
class TurnPace {
  public:
    TurnPace() = default;
    TurnPace(const Turn& turn, const MotionLimits& limits);

    /// The least time that the limits allow.
    [[nodiscard]] double time() const { return time_s_; }

    /// The angle turned by at a share of the time, 0..1, however much time is taken: a turn that
    /// takes longer is slower all along.
    [[nodiscard]] double turnedAt(double share) const;

  private:
    double angle_ = 0.0;
    double acceleration_ = 0.0;
    double ramp_s_ = 0.0;
    double time_s_ = 0.0;
};

}  // namespace dollytrack::planning
