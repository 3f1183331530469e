#pragma once

#include <Eigen/Core>

#include <span>

namespace dollytrack {

/// Turns, moves and scales: p_out = scale * rotation * p_in + translation.
struct Similarity {
    double scale = 1.0;
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();

    [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
        return scale * (rotation * point) + translation;
    }
};

/// What brings `from` onto `onto` with the smallest sum of squared distances; from[i] belongs to
/// onto[i]. Without `with_scale` the scale is 1. Never mirrors. Fewer than two points, or points
/// that are all the same, are only moved; points on a line leave the turn about it open.
[[nodiscard]] Similarity alignPoints(std::span<const Eigen::Vector3d> from,
                                     std::span<const Eigen::Vector3d> onto, bool with_scale);

}  // namespace dollytrack
