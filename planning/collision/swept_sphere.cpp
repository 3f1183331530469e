#include "planning/collision/swept_sphere.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/allowed_region.h"
#include "planning/free_space/free_space.h"
#include "planning/rooms/room_plan.h"

#include <algorithm>
#include <limits>

namespace dollytrack::planning {
namespace {

// Clearance beyond the radius below which a step counts as contact, so that the proof terminates.
constexpr double kContact = 0.001;
// The distance field's lower bound is enough where the excess clearance is larger than this.
constexpr double kPlenty = 0.05;
// Longest step, m: the state of cells is tested at least this often, even far from surfaces.
constexpr double kLongestStep = 0.25;

}  // namespace

SweptSphere::SweptSphere(const RayCaster& rays, const FreeSpace& free_space, double radius_m,
                         const AllowedRegion* region, const RoomPlan* rooms)
    : rays_(&rays),
      free_space_(&free_space),
      radius_m_(radius_m),
      region_(region && region->restricts() ? region : nullptr),
      rooms_(rooms) {}

double SweptSphere::clearance(const Eigen::Vector3d& position, double limit) const {
    const double bound = free_space_->clearanceLowerBound(position);
    if (bound >= limit) return bound;
    return std::min(rays_->closest(position, limit).distance, limit);
}

bool SweptSphere::fits(const Eigen::Vector3d& position) const {
    const double reach = radius_m_ + kMargin;
    return free_space_->componentAt(position) >= 0 &&
           (free_space_->clearanceLowerBound(position) >= reach ||
            rays_->isClear(position, reach)) &&
           (!region_ || region_->verdict(position, reach) == Verdict::Legal);
}

Verdict SweptSphere::verdict(const Eigen::Vector3d& position, int& object_id) const {
    object_id = 0;
    if (fits(position)) return Verdict::Legal;
    const double reach = radius_m_ + kMargin;
    const Verdict allowed = region_ ? region_->verdict(position, reach) : Verdict::Legal;
    if (allowed == Verdict::NoGo) return allowed;
    object_id = rays_->closest(position, reach).object_id;
    if (object_id == 0 && allowed == Verdict::InObstacle) {
        object_id = region_->bodyClearance(position).object_id;
    }
    if (object_id != 0 || free_space_->stateAt(position) == CellState::Occupied) {
        return Verdict::InObstacle;
    }
    // Outside the rooms there is no floor to measure heights from, so the band says nothing.
    return free_space_->componentAt(position) < 0 ? Verdict::OutsideRoom : allowed;
}

Eigen::Vector3d SweptSphere::inBand(const Eigen::Vector3d& place) const {
    return region_ ? region_->inBand(place) : place;
}

Eigen::Vector3d SweptSphere::onHeight(const Eigen::Vector3d& place) const {
    return region_ && region_->hasLevels() ? region_->inBand(place) : place;
}

const std::vector<Eigen::Vector3f>& SweptSphere::cells(int component) const {
    return region_ ? region_->cells(component) : free_space_->cells(component);
}

SweepResult SweptSphere::segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    return bezier(from, 0.5 * (from + to), to);
}

SweepResult SweptSphere::bezier(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                                const Eigen::Vector3d& end) const {
    // |B'(t)| never exceeds this, so t may grow by (free distance) / speed.
    const double speed = 2.0 * std::max((control - start).norm(), (end - control).norm());
    // Both ends of a straight move lie in one free leaf of the octree, so all of it is free space.
    const bool inside = control == 0.5 * (start + end) && free_space_->inOneFreeLeaf(start, end);
    SweepResult sweep;
    sweep.min_clearance_m = std::numeric_limits<double>::infinity();
    if (region_ && !region_->bandHolds(start, control, end, sweep.collision)) {
        sweep.min_clearance_m = clearance(sweep.collision, radius_m_ + kPlenty);
        sweep.reason = Verdict::HeightBand;
        return sweep;
    }
    if (rooms_ && !rooms_->inOneRoom(start, control, end, sweep.collision)) {
        sweep.min_clearance_m = clearance(sweep.collision, radius_m_ + kPlenty);
        sweep.reason = Verdict::OutsideRoom;
        return sweep;
    }
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
                sweep.reason = Verdict::InObstacle;
                sweep.min_clearance_m = std::min(sweep.min_clearance_m, distance);
                return sweep;
            }
        }
        if (!inside && free_space_->stateAt(position) != CellState::Free) {
            sweep.collision = position;
            sweep.reason = Verdict::OutsideRoom;
            return sweep;
        }
        const double to_no_go = region_ ? region_->noGoDistance(position) : distance;
        if (to_no_go < radius_m_ + kContact) {
            sweep.collision = position;
            sweep.reason = Verdict::NoGo;
            return sweep;
        }
        const BodyClearance body = region_ ? region_->bodyClearance(position) : BodyClearance{};
        if (body.free_m < kContact) {
            sweep.collision = position;
            sweep.object_id = body.object_id;
            sweep.reason = Verdict::InObstacle;
            return sweep;
        }
        sweep.min_clearance_m = std::min(sweep.min_clearance_m, distance);
        if (t >= 1.0) break;
        const double step =
            std::min({std::min(distance, to_no_go) - radius_m_, body.free_m, kLongestStep});
        t = speed > 0.0 ? std::min(1.0, t + step / speed) : 1.0;
    }
    sweep.free = true;
    return sweep;
}

}  // namespace dollytrack::planning
