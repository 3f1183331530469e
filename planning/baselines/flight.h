#pragma once

#include "engine/camera/trajectory.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// A trajectory and how the camera gets from one of its frames to the next: what a planner hands
/// in to be judged.
struct Flight {
    Trajectory trajectory;
    /// By frame: the places passed on the way to the next one, in order, without the two ends.
    /// Nothing, or no entry: straight.
    std::vector<std::vector<Eigen::Vector3d>> between;
    /// Share of the rounded corners that could not be proven free; where corners are rounded.
    std::optional<double> corner_collision_rate;
    /// What the planning itself took, where the call did more than that; else nothing.
    std::optional<double> plan_ms;
};

/// The whole way from frame `from` to the next one: both ends and what lies between. Empty where
/// there is no motion: after the last frame, and where the camera is carried over to another path.
std::vector<Eigen::Vector3d> wayToNext(const Flight& flight, std::size_t from);

}  // namespace dollytrack::planning
