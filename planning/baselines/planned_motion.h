#pragma once

#include "engine/camera/trajectory.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// A planner's result: a trajectory, and the camera's motion between its frames.
struct PlannedMotion {
    Trajectory trajectory;
    /// By frame: intermediate positions on the way to the next frame, in order, without both ends.
    /// Empty, or a missing entry: a straight line.
    std::vector<std::vector<Eigen::Vector3d>> between;
    /// Share of the rounded corners that could not be proven collision-free; empty if the planner
    /// does not round corners.
    std::optional<double> corner_collision_rate;
    /// Planning time, if the planner measures it itself; otherwise the call is timed.
    std::optional<double> plan_ms;
};

/// The polyline from frame `from` to the next one, both ends included. Empty if there is no motion:
/// after the last frame, and between frames of different paths.
std::vector<Eigen::Vector3d> wayToNext(const PlannedMotion& motion, std::size_t from);

}  // namespace dollytrack::planning
