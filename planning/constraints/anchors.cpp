#include "planning/constraints/anchors.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/rooms/room_plan.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dollytrack::planning {
namespace {

constexpr double kStep_m = 0.1;
constexpr double kHighest_m = 0.8;   // largest vertical offset from the wished position
constexpr double kFarthest_m = 1.5;  // from an opening to the camera
constexpr double kNearest_m = 0.3;
constexpr double kLooksAhead_m = 2.0;

/// Openings in ceilings and floors do not count.
bool isWindow(const Opening& hole) {
    return std::abs(hole.outwards.z()) <= 0.5;
}

class Finder {
  public:
    explicit Finder(const PlanningEnvironment& environment) : environment_(environment) {}

    /// The legal position nearest above or below.
    [[nodiscard]] std::optional<Eigen::Vector3d> legalNear(const Eigen::Vector3d& wish) const {
        const Eigen::Vector3d start = environment_.sphere.inBand(wish);
        for (double off = 0.0; off <= kHighest_m; off += kStep_m) {
            for (const double sign : {1.0, -1.0}) {
                const Eigen::Vector3d place = start + sign * off * Eigen::Vector3d::UnitZ();
                if (environment_.sphere.fits(place)) return place;
            }
        }
        return std::nullopt;
    }

    void doorway(const Doorway& door, std::vector<Pose>& views) const {
        // Also try beside the centre: the narrowest point may not be at the centre of a cell.
        for (const double along : {0.0, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3}) {
            const auto place = legalNear(door.center + along * door.through);
            if (!place) continue;
            views.push_back(aim(*place, *place + kLooksAhead_m * door.through, environment_.pitch));
            return;
        }
    }

    void opening(const Opening& hole, std::vector<Pose>& views) const {
        for (double back = kFarthest_m; back >= kNearest_m; back -= kStep_m) {
            const auto place = legalNear(hole.center_in_world - back * hole.outwards);
            if (!place || environment_.free_space.componentAt(*place) != hole.component) continue;
            // The centre of a large opening may be blocked.
            const Eigen::Vector3d way = hole.center_in_world - *place;
            const RayHit hit = environment_.views.rays().cast(*place, way, 1.0);
            if (hit.object_id != 0) continue;
            views.push_back(aim(*place, hole.center_in_world, environment_.pitch));
            return;
        }
    }

    void corridor(const PlanRoom& room, std::vector<Pose>& views) const {
        for (const bool there : {true, false}) {
            const Eigen::Vector3d from = there ? room.near_end : room.far_end;
            const Eigen::Vector3d to = there ? room.far_end : room.near_end;
            const double length = (to - from).norm();
            for (double in = 0.0; in < 0.5 * length; in += kStep_m) {
                const auto place = legalNear(from + in / length * (to - from));
                if (!place) continue;
                views.push_back(aim(*place, {to.x(), to.y(), place->z()}, environment_.pitch));
                break;
            }
        }
    }

  private:
    const PlanningEnvironment& environment_;
};

}  // namespace

std::vector<Anchors> anchorKinds(Anchors wanted) {
    if (wanted == Anchors::None) return {};
    if (wanted != Anchors::All) return {wanted};
    return {Anchors::Doorways, Anchors::Openings, Anchors::Corridors};
}

std::vector<AnchorViews> anchorViews(const RoomPlan& rooms, Anchors wanted,
                                     const PlanningEnvironment& environment) {
    const Finder finder(environment);
    const std::vector<Anchors> kinds = anchorKinds(wanted);
    const auto wants = [&](Anchors kind) {
        return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
    };
    std::vector<AnchorViews> anchors;
    const auto add = [&](Anchors kind) -> std::vector<Pose>& {
        return anchors.emplace_back(AnchorViews{kind, {}}).views;
    };
    if (wants(Anchors::Doorways)) {
        for (Doorway door : rooms.doorways()) {
            // Rooms are numbered by size, the largest first.
            if (door.room_a > door.room_b) door.through = -door.through;
            finder.doorway(door, add(Anchors::Doorways));
        }
    }
    if (wants(Anchors::Openings)) {
        for (const Opening& hole : environment.free_space.openingReport().openings) {
            if (isWindow(hole)) finder.opening(hole, add(Anchors::Openings));
        }
    }
    if (wants(Anchors::Corridors)) {
        for (const PlanRoom& room : rooms.rooms()) {
            if (room.corridor) finder.corridor(room, add(Anchors::Corridors));
        }
    }
    return anchors;
}

}  // namespace dollytrack::planning
