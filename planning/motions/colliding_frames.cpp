#include "planning/motions/colliding_frames.h"

#include "engine/plan/plan.h"

#include <cstddef>

namespace dollytrack::planning {

std::vector<CollidingFrames> collidingFrames(const Plan& plan) {
    std::vector<CollidingFrames> collisions;
    const auto& frames = plan.trajectory.frames;
    bool inside = false;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const TrajectoryFrame& frame = frames[i];
        const bool first = i == 0 || frames[i - 1].path != frame.path;
        if (first) inside = false;
        if (static_cast<std::size_t>(frame.path) >= plan.smooth_paths.size()) continue;
        const SmoothPath& path = plan.smooth_paths[static_cast<std::size_t>(frame.path)];
        bool collides = first && path.pieces.empty() && path.collisions > 0;
        const bool goes_on = i + 1 < frames.size() && frames[i + 1].path == frame.path;
        if (goes_on) {
            const bool rests = frames[i + 1].arc_m == frame.arc_m;
            if (!path.pieces.empty()) {
                collides = rests ? inside : path.pieces[path.pieceAt(frame.arc_m)].collides;
            }
        }
        const int here = static_cast<int>(i);
        if (collides && !inside) collisions.push_back({here, here});
        if (collides && goes_on && !path.pieces.empty()) collisions.back().last = here + 1;
        inside = collides;
    }
    return collisions;
}

}  // namespace dollytrack::planning
