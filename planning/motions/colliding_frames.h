#pragma once

#include <vector>

namespace dollytrack {
struct Plan;
}

namespace dollytrack::planning {

/// The first frame of each stretch of a given motion that collides, in the order of the frames. A
/// stretch is a row of colliding moves from one frame to the next, or a path that stays at one
/// place in collision. Empty for trajectories that were planned.
[[nodiscard]] std::vector<int> collidingFrames(const Plan& plan);

}  // namespace dollytrack::planning
