#include "planning/motions/colliding_frames.h"

#include "engine/geometry/ray_caster.h"
#include "engine/plan/plan.h"

#include <algorithm>
#include <cstddef>

namespace dollytrack::planning {

namespace {

constexpr std::size_t kNamed = 200;  // collisions whose object is looked for
constexpr int kSamples = 32;         // positions of a collision that are compared

/// The object nearest to the camera between the frames.
int objectHit(const Plan& plan, const CollidingFrames& collision, const RayCaster& rays,
              double camera_radius_m) {
    const auto& frames = plan.trajectory.frames;
    int object_id = 0;
    double nearest = camera_radius_m;
    for (int k = 0; k <= kSamples; ++k) {
        const double at = collision.first + double(collision.last - collision.first) * k / kSamples;
        const auto frame = static_cast<std::size_t>(at);
        const std::size_t next = std::min(frame + 1, static_cast<std::size_t>(collision.last));
        const Eigen::Vector3d& from = frames[frame].pose.position;
        const Eigen::Vector3d place =
            from + (at - double(frame)) * (frames[next].pose.position - from);
        const ClosestPoint closest = rays.closest(place, nearest);
        if (closest.object_id == 0) continue;
        object_id = closest.object_id;
        nearest = closest.distance;
    }
    return object_id;
}

}  // namespace

std::vector<CollidingFrames> collidingFrames(const Plan& plan, const RayCaster& rays,
                                             double camera_radius_m) {
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
        if (collides && !inside) collisions.push_back({here, here, 0});
        if (collides && goes_on && !path.pieces.empty()) collisions.back().last = here + 1;
        inside = collides;
    }
    for (std::size_t i = 0; i < std::min(kNamed, collisions.size()); ++i) {
        collisions[i].object_id = objectHit(plan, collisions[i], rays, camera_radius_m);
    }
    return collisions;
}

}  // namespace dollytrack::planning
