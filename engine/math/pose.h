#pragma once

#include <Eigen/Geometry>

namespace dollytrack {

/// A camera's place in the world: right-handed, z up, metres. The camera's own axes are
/// x right, y down, z forward (OpenCV). Transforms read right to left: world_from_camera.
struct Pose {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // world_from_camera

    [[nodiscard]] Eigen::Vector3d forward() const { return rotation * Eigen::Vector3d::UnitZ(); }
    [[nodiscard]] Eigen::Vector3d toWorld(const Eigen::Vector3d& in_camera) const {
        return rotation * in_camera + position;
    }
    [[nodiscard]] Eigen::Vector3d toCamera(const Eigen::Vector3d& in_world) const {
        return rotation.conjugate() * (in_world - position);
    }
    [[nodiscard]] Eigen::Isometry3d worldFromCamera() const;
    bool operator==(const Pose&) const = default;
};

/// Rotation of a camera that looks along `forward` (need not be unit) with roll 0. Straight up or
/// down, where roll has no meaning, the camera's x axis is `right_when_vertical`.
Eigen::Quaterniond lookAlong(const Eigen::Vector3d& forward,
                             const Eigen::Vector3d& right_when_vertical = Eigen::Vector3d::UnitX());

/// A pose at `from` that looks at `to`, roll 0.
Pose lookAt(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// Angle between two orientations, radians, 0..pi.
double angleBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

/// Angle between two directions (need not be unit), radians, 0..pi.
double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// The same direction of view with roll taken out (slerp of two roll-free poses rolls).
Eigen::Quaterniond withoutRoll(const Eigen::Quaterniond& rotation);

}  // namespace dollytrack
