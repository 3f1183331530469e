#pragma once

#include <Eigen/Core>

#include <numbers>

namespace dollytrack::planning {

struct BodyParams;

/// Largest angle between where the camera looks and where it moves, both seen from above, rad. Pi:
/// it looks anywhere.
struct HeadingLimit {
    double angle = std::numbers::pi;
    bool operator==(const HeadingLimit&) const = default;

    [[nodiscard]] bool restricts() const { return angle < std::numbers::pi; }
    /// Whether a camera with this view may pass in a motion in this direction. Upright motion has
    /// no heading, and an upright view none that could be right.
    [[nodiscard]] bool allows(const Eigen::Vector3d& view, const Eigen::Vector3d& motion) const;
};

[[nodiscard]] HeadingLimit headingLimit(const BodyParams& params);

/// Angle between two directions seen from above, 0..pi.
[[nodiscard]] double angleFromAbove(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Whether a direction is so steep that it has no heading.
[[nodiscard]] bool isUpright(const Eigen::Vector3d& direction);

}  // namespace dollytrack::planning
