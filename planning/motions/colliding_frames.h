#pragma once

#include <vector>

namespace dollytrack {
struct Plan;
}

namespace dollytrack::planning {

/// Consecutive colliding moves between frames: the frame where the first begins and the frame where
/// the last ends. The two are equal for a path that stays at one position in collision.
struct CollidingFrames {
    int first = 0;
    int last = 0;
};

/// The collisions of a given motion, in the order of the frames. Empty for trajectories that were
/// planned.
[[nodiscard]] std::vector<CollidingFrames> collidingFrames(const Plan& plan);

}  // namespace dollytrack::planning
