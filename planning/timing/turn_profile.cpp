#include "planning/timing/turn_profile.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {

TurnProfile::TurnProfile(const Turn& turn, const MotionLimits& limits) : angle_(turn.angle()) {
    if (angle_ <= 0.0) return;
    // Largest share of the acceleration limit that the moving axis may take; the rest speeds up and
    // slows down.
    constexpr double kAcross = 0.8;
    const double most = limits.turn_acceleration_rps2;
    const double bend = std::max(turn.bend(), 1e-9);
    const double rate = std::min(limits.turn_rps, std::sqrt(kAcross * most / bend));
    const double across = rate * rate * bend;
    acceleration_ = std::sqrt(std::max(0.0, most * most - across * across));
    ramp_s_ = std::min(rate / acceleration_, std::sqrt(angle_ / acceleration_));
    time_s_ = ramp_s_ + angle_ / (acceleration_ * ramp_s_);
}

double TurnProfile::turnedAt(double share) const {
    if (angle_ <= 0.0 || share <= 0.0) return 0.0;
    if (share >= 1.0) return angle_;
    const double t = share * time_s_;
    const double left = time_s_ - t;
    if (t < ramp_s_) return 0.5 * acceleration_ * t * t;
    if (left < ramp_s_) return angle_ - 0.5 * acceleration_ * left * left;
    return acceleration_ * ramp_s_ * (t - 0.5 * ramp_s_);
}

}  // namespace dollytrack::planning
