#pragma once

#include <Eigen/Core>

#include <numbers>

namespace dollytrack::planning {

struct BodyParams;

/// Largest angle between viewing direction and direction of motion, both seen from above, rad. Pi
/// means no limit.
struct HeadingLimit {
    double angle = std::numbers::pi;
    bool operator==(const HeadingLimit&) const = default;

    [[nodiscard]] bool restricts() const { return angle < std::numbers::pi; }
    /// Whether the camera may look along `view` while it moves along `motion`. Always true for
    /// vertical motion; false for a vertical view in other motion, because it has no heading.
    [[nodiscard]] bool allows(const Eigen::Vector3d& view, const Eigen::Vector3d& motion) const;
};

[[nodiscard]] HeadingLimit headingLimit(const BodyParams& params);

/// Angle between the horizontal components of two directions, 0..pi.
[[nodiscard]] double angleFromAbove(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Whether a direction is so close to vertical (within about 3 degrees) that it has no heading.
[[nodiscard]] bool isUpright(const Eigen::Vector3d& direction);

}  // namespace dollytrack::planning
