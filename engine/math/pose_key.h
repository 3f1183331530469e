#pragma once

#include "engine/math/pose.h"

#include <array>

namespace dollytrack {

/// A pose as numbers that can be ordered: the key of caches of results for exactly that pose.
[[nodiscard]] inline std::array<double, 7> keyOf(const Pose& pose) {
    const Eigen::Vector3d& p = pose.position;
    const Eigen::Quaterniond& q = pose.rotation;
    return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

[[nodiscard]] inline Pose poseOf(const std::array<double, 7>& key) {
    return {{key[0], key[1], key[2]}, Eigen::Quaterniond(key[6], key[3], key[4], key[5])};
}

}  // namespace dollytrack
