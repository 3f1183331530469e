#pragma once

#include "engine/math/pose.h"

#include <numbers>

namespace dollytrack::planning {

struct ConstraintParams;

/// Allowed elevations of the viewing direction, rad; positive is up.
struct PitchBand {
    double lowest = -0.5 * std::numbers::pi;
    double highest = 0.5 * std::numbers::pi;
    bool operator==(const PitchBand&) const = default;

    /// Whether any elevation is excluded.
    [[nodiscard]] bool restricts() const;
    /// Whether a camera with this orientation looks within the band, up to rounding.
    [[nodiscard]] bool holds(const Eigen::Quaterniond& rotation) const;
    /// The allowed elevation nearest to the given one.
    [[nodiscard]] double nearest(double elevation) const;
};

PitchBand pitchBand(const ConstraintParams& params);

/// Elevation of a direction of any length, rad.
double elevationOf(const Eigen::Vector3d& direction);

/// The direction as a unit vector, with its elevation clamped to the band and its heading kept. A
/// vertical direction gets the heading +x.
Eigen::Vector3d intoBand(const Eigen::Vector3d& direction, const PitchBand& band);

/// The roll-free pose at `from` that looks at `to`, with its elevation clamped to the band. If
/// clamped, `to` is not in the image centre.
Pose aim(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const PitchBand& band);

}  // namespace dollytrack::planning
