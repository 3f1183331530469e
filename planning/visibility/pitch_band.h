#pragma once

#include "engine/math/pose.h"

#include <numbers>

namespace dollytrack::planning {

struct ConstraintParams;

/// How steeply the camera may look: elevations of its viewing direction, rad, up is positive.
struct PitchBand {
    double lowest = -0.5 * std::numbers::pi;
    double highest = 0.5 * std::numbers::pi;
    bool operator==(const PitchBand&) const = default;

    /// False: every elevation is allowed.
    [[nodiscard]] bool restricts() const;
    /// Whether a camera with this orientation looks within the band, to rounding.
    [[nodiscard]] bool holds(const Eigen::Quaterniond& rotation) const;
    /// The elevation nearest to the one given.
    [[nodiscard]] double nearest(double elevation) const;
};

PitchBand pitchBand(const ConstraintParams& params);

/// Elevation of a direction, rad; need not be unit.
double elevationOf(const Eigen::Vector3d& direction);

/// The direction, unit, raised or lowered into the band.
Eigen::Vector3d intoBand(const Eigen::Vector3d& direction, const PitchBand& band);

/// The camera's pose at `from` that looks at `to` as far as the band lets it: where that is too
/// steep the target is off the image's middle.
Pose aim(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const PitchBand& band);

}  // namespace dollytrack::planning
