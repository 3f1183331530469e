#pragma once

#include "engine/camera/trajectory.h"

#include <vector>

namespace dollytrack {

/// What an inertial sensor at the camera's centre, with the camera's axes, would measure.
struct ImuSample {
    double time_s = 0.0;
    Eigen::Vector3d rate_rps = Eigen::Vector3d::Zero();             // angular velocity
    Eigen::Vector3d specific_force_mps2 = Eigen::Vector3d::Zero();  // acceleration less gravity:
                                                                    // at rest 9.80665 upwards
};

/// The standard acceleration of gravity.
inline constexpr double kGravity_mps2 = 9.80665;

/// Perfect measurements at a fixed rate along one continuous motion, from its first to its last
/// frame, both included: derivatives of the twice continuously differentiable spline through all
/// poses. Frames by rising time. Empty for fewer than two.
[[nodiscard]] std::vector<ImuSample> imuTrack(const std::vector<TrajectoryFrame>& motion,
                                              double rate_hz);

}  // namespace dollytrack
