#pragma once

#include <vector>

namespace dollytrack {
struct Plan;
}

namespace dollytrack::planning {

/// The first frame of each collision of a given motion, in the order of the frames. A collision is
/// a run of consecutive colliding moves between frames, or a path that stays at one position in
/// collision. Empty for trajectories that were planned.
[[nodiscard]] std::vector<int> collidingFrames(const Plan& plan);

}  // namespace dollytrack::planning
