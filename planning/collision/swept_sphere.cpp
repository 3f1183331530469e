#include "planning/collision/swept_sphere.h"

#include "engine/geometry/ray_caster.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <limits>

namespace dollytrack::planning {
namespace {

// Below this excess over the radius a step would no longer get anywhere: counts as contact.
constexpr double kContact = 0.001;
// The field's lower bound spares the exact question where there is plenty of room.
constexpr double kPlenty = 0.05;
// Even in the open each step looks at free space again, at about the spacing of its cells.
constexpr double kLongestStep = 0.25;

}  // namespace

SweptSphere::SweptSphere(const RayCaster& rays, const FreeSpace& free_space, double radius_m)
    : rays_(&rays), free_space_(&free_space), radius_m_(radius_m) {}

double SweptSphere::clearance(const Eigen::Vector3d& position, double limit) const {
    const double bound = free_space_->clearanceLowerBound(position);
    if (bound >= limit) return bound;
    return std::min(rays_->closest(position, limit).distance, limit);
}

bool SweptSphere::fits(const Eigen::Vector3d& position) const {
    return free_space_->componentAt(position) >= 0 &&
           clearance(position, radius_m_ + kMargin) >= radius_m_ + kMargin;
}

Sweep SweptSphere::segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    return bezier(from, 0.5 * (from + to), to);
}

Sweep SweptSphere::bezier(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                          const Eigen::Vector3d& end) const {
    // |B'(t)| never exceeds this, so t may grow by (free distance) / speed.
    const double speed = 2.0 * std::max((control - start).norm(), (end - control).norm());
    // Both ends of a straight move in one free leaf of the octree: all between is free space.
    const bool inside = control == 0.5 * (start + end) && free_space_->inOneFreeLeaf(start, end);
    Sweep sweep;
    sweep.min_clearance_m = std::numeric_limits<double>::infinity();
    double t = 0.0;
    while (true) {
        const double u = 1.0 - t;
        const Eigen::Vector3d position = u * u * start + 2.0 * u * t * control + t * t * end;
        double distance = free_space_->clearanceLowerBound(position);
        if (distance < radius_m_ + kPlenty) {
            const double limit = radius_m_ + 2.0 * kPlenty;
            const ClosestPoint closest = rays_->closest(position, limit);
            distance = std::min(closest.distance, limit);
            if (distance < radius_m_ + kContact) {
                sweep.collision = position;
                sweep.object_id = closest.object_id;
                sweep.min_clearance_m = std::min(sweep.min_clearance_m, distance);
                return sweep;
            }
        }
        if (!inside && free_space_->stateAt(position) != CellState::Free) {
            sweep.collision = position;
            return sweep;
        }
        sweep.min_clearance_m = std::min(sweep.min_clearance_m, distance);
        if (t >= 1.0) break;
        const double step = std::min(distance - radius_m_, kLongestStep);
        t = speed > 0.0 ? std::min(1.0, t + step / speed) : 1.0;
    }
    sweep.free = true;
    return sweep;
}

}  // namespace dollytrack::planning
