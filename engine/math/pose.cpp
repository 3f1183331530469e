#include "engine/math/pose.h"

#include <cmath>

namespace dollytrack {

Eigen::Isometry3d Pose::worldFromCamera() const {
    Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
    transform.linear() = rotation.toRotationMatrix();
    transform.translation() = position;
    return transform;
}

Eigen::Quaterniond lookAlong(const Eigen::Vector3d& forward,
                             const Eigen::Vector3d& right_when_vertical) {
    const Eigen::Vector3d z = forward.normalized();
    Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ());
    // Below 1e-6 the horizontal part is rounding error, and normalizing it would give an arbitrary
    // heading.
    if (x.norm() < 1e-6) x = right_when_vertical - z * z.dot(right_when_vertical);
    x.normalize();
    Eigen::Matrix3d rotation;
    rotation.col(0) = x;
    rotation.col(1) = z.cross(x);
    rotation.col(2) = z;
    return Eigen::Quaterniond(rotation).normalized();
}

Pose lookAt(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return {from, lookAlong(to - from)};
}

double angleBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
    return a.angularDistance(b);
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Quaterniond withoutRoll(const Eigen::Quaterniond& rotation) {
    return lookAlong(rotation * Eigen::Vector3d::UnitZ(), rotation * Eigen::Vector3d::UnitX());
}

}  // namespace dollytrack
