#pragma once

#include "engine/camera/pose_spline.h"

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

/// Perfect measurements at a fixed rate, counted from the path's beginning: derivatives of the
/// spline. From the last at or before `from_s` to the first at or after `to_s`, within the path, so
/// that a part of a path has the samples that the whole has there. Empty without a rate.
[[nodiscard]] std::vector<ImuSample> imuTrack(const PoseSpline& path, double rate_hz, double from_s,
                                              double to_s);

}  // namespace dollytrack
