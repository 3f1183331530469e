#pragma once

#include <vector>

namespace dollytrack {
class RayCaster;
struct Plan;
}  // namespace dollytrack

namespace dollytrack::planning {

/// Consecutive colliding moves between frames: the frame where the first begins and the frame where
/// the last ends. The two are equal for a path that stays at one position in collision.
struct CollidingFrames {
    int first = 0;
    int last = 0;
    // The object that the camera comes nearest to. 0: none within its radius, as outside of the
    // rooms or in a no-go box, or not looked for: only the first 200 collisions are.
    int object_id = 0;
};

/// The collisions of a given motion, in the order of the frames, with the objects of the scene that
/// `rays` was built from. Empty for trajectories that were planned.
[[nodiscard]] std::vector<CollidingFrames> collidingFrames(const Plan& plan, const RayCaster& rays,
                                                           double camera_radius_m);

}  // namespace dollytrack::planning
