#include "planning/motions/colliding_frames.h"

#include "engine/plan/plan.h"

#include <cstddef>

namespace dollytrack::planning {

std::vector<int> collidingFrames(const Plan& plan) {
    std::vector<int> begins;
    const auto& frames = plan.trajectory.frames;
    bool inside = false;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const TrajectoryFrame& frame = frames[i];
        const bool first = i == 0 || frames[i - 1].path != frame.path;
        if (first) inside = false;
        if (static_cast<std::size_t>(frame.path) >= plan.smooth_paths.size()) continue;
        const SmoothPath& path = plan.smooth_paths[static_cast<std::size_t>(frame.path)];
        bool collides = first && path.pieces.empty() && path.collisions > 0;
        if (i + 1 < frames.size() && frames[i + 1].path == frame.path) {
            const bool rests = frames[i + 1].arc_m == frame.arc_m;
            if (!path.pieces.empty()) {
                collides = rests ? inside : path.pieces[path.pieceAt(frame.arc_m)].collides;
            }
        }
        if (collides && !inside) begins.push_back(static_cast<int>(i));
        inside = collides;
    }
    return begins;
}

}  // namespace dollytrack::planning
