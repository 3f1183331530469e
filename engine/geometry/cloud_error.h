#pragma once

#include "engine/geometry/ray_caster.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace dollytrack {

/// Errors of a reconstructed point cloud: distances of its points to the true surfaces.
struct CloudError {
    int points = 0;
    double mean_m = 0.0;  // of the distances to the nearest surface
    double median_m = 0.0;
    double p90_m = 0.0;  // 90 % are nearer
    double p95_m = 0.0;
};

/// Measures `cloud` (world frame) against the scene's triangles.
[[nodiscard]] CloudError cloudError(std::span<const Eigen::Vector3d> cloud, const RayCaster& rays);

/// The share of `surface` that has a point of the cloud within `radius_m`.
[[nodiscard]] double coveredShare(std::span<const Eigen::Vector3d> surface,
                                  std::span<const Eigen::Vector3d> cloud, double radius_m);

}  // namespace dollytrack
