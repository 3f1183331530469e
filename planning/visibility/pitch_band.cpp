#include "planning/visibility/pitch_band.h"

#include "planning/plan_params.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {
namespace {

constexpr double kRight = 0.5 * std::numbers::pi;
// Clamped elevations stay this far inside the band, since a quaternion's elevation is rounded.
constexpr double kPitchTolerance = 1e-9;

}  // namespace

bool PitchBand::restricts() const {
    return lowest > -kRight || highest < kRight;
}

bool PitchBand::holds(const Eigen::Quaterniond& rotation) const {
    const double elevation = elevationOf(rotation * Eigen::Vector3d::UnitZ());
    return elevation >= lowest - kPitchTolerance && elevation <= highest + kPitchTolerance;
}

double PitchBand::nearest(double elevation) const {
    const double hair = std::min(kPitchTolerance, 0.5 * (highest - lowest));
    return std::clamp(elevation, lowest + hair, highest - hair);
}

PitchBand pitchBand(const ConstraintParams& params) {
    constexpr double kRadians = std::numbers::pi / 180.0;
    PitchBand band;
    if (params.min_pitch_deg > -90.0) band.lowest = params.min_pitch_deg * kRadians;
    if (params.max_pitch_deg < 90.0) band.highest = params.max_pitch_deg * kRadians;
    return band;
}

double elevationOf(const Eigen::Vector3d& direction) {
    return std::atan2(direction.z(), direction.head<2>().norm());
}

Eigen::Vector3d intoBand(const Eigen::Vector3d& direction, const PitchBand& band) {
    const double elevation = elevationOf(direction);
    const double allowed = band.nearest(elevation);
    if (allowed == elevation) return direction.normalized();
    const double level = direction.head<2>().norm();
    // A vertical direction has no heading to keep.
    const Eigen::Vector2d heading =
        level > 1e-9 ? Eigen::Vector2d(direction.head<2>() / level) : Eigen::Vector2d::UnitX();
    return {std::cos(allowed) * heading.x(), std::cos(allowed) * heading.y(), std::sin(allowed)};
}

Pose aim(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const PitchBand& band) {
    if (!band.restricts()) return lookAt(from, to);
    return {from, lookAlong(intoBand(to - from, band))};
}

}  // namespace dollytrack::planning
