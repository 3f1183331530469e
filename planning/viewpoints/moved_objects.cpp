#include "planning/viewpoints/moved_objects.h"

#include "planning/collision/allowed_region.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/viewpoints/gap_test.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace dollytrack::planning {
namespace {

// Ray queries use floats: a ray that passes an object by less than this counts as hitting it.
constexpr double kMovedTolerance_m = 0.002;

const std::vector<Eigen::Vector3f>& cellsOf(const FreeSpace& map, const AllowedRegion* region,
                                            std::size_t room) {
    static const std::vector<Eigen::Vector3f> none;
    if (room >= map.rooms().size()) return none;
    const int component = static_cast<int>(room);
    return region != nullptr && region->restricts() ? region->cells(component)
                                                    : map.cells(component);
}

/// Whether the segment meets the box grown by `half` on each side.
bool segmentMeets(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& half,
                  const Eigen::AlignedBox3d& box) {
    double enter = 0.0;
    double leave = 1.0;
    for (int k = 0; k < 3; ++k) {
        const double low = box.min()[k] - half[k] - a[k];
        const double high = box.max()[k] + half[k] - a[k];
        const double way = b[k] - a[k];
        if (way == 0.0) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const auto [first, last] = std::minmax({low / way, high / way});  // by value
        enter = std::max(enter, first);
        leave = std::min(leave, last);
    }
    return enter <= leave;
}

}  // namespace

Eigen::AlignedBox3d reachedBox(const ViewEstimator& views, int object_id) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& corner : views.scene().object(object_id).box.corners()) {
        box.extend(corner);
    }
    for (const Eigen::Vector3d& point : views.extremes(object_id)) box.extend(point);
    // Rays end behind the object's bounds, which are slightly wider than the object, with relative
    // margins of some 1e-4.
    const double furthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.02 + 5e-4 * furthest);
    return {box.min() - margin, box.max() + margin};
}

void MovedObjects::add(const std::vector<int>& objects,
                       const std::vector<Eigen::AlignedBox3d>& boxes) {
    objects_.insert(objects_.end(), objects.begin(), objects.end());
    std::ranges::sort(objects_);
    objects_.erase(std::unique(objects_.begin(), objects_.end()), objects_.end());
    for (const Eigen::AlignedBox3d& box : boxes) {
        const Eigen::Vector3d hair = Eigen::Vector3d::Constant(kMovedTolerance_m);
        const Eigen::AlignedBox3d grown(box.min() - hair, box.max() + hair);
        // Dragging an object adds many boxes inside one another.
        const bool known = std::ranges::any_of(
            boxes_, [&](const Eigen::AlignedBox3d& other) { return other.contains(grown); });
        if (!known) boxes_.push_back(grown);
    }
}

void MovedObjects::clear() {
    objects_.clear();
    boxes_.clear();
}

bool MovedObjects::isOne(int object_id) const {
    return std::ranges::binary_search(objects_, object_id);
}

bool MovedObjects::near(const Eigen::Vector3d& point, double distance_m) const {
    return std::ranges::any_of(boxes_, [&](const Eigen::AlignedBox3d& box) {
        return box.squaredExteriorDistance(point) <= distance_m * distance_m;
    });
}

bool MovedObjects::meet(const Eigen::AlignedBox3d& box) const {
    return std::ranges::any_of(
        boxes_, [&](const Eigen::AlignedBox3d& other) { return other.intersects(box); });
}

bool MovedObjects::cross(const Eigen::Vector3d& from, const Eigen::AlignedBox3d& target) const {
    // The rays fill a cone from the point to the box; cut it into pieces and bound each by a box
    // swept along the axis.
    constexpr int kPieces = 8;
    Eigen::AlignedBox3d around = target;
    around.extend(from);
    const Eigen::Vector3d way = target.center() - from;
    const Eigen::Vector3d half = 0.5 * target.sizes();
    return std::ranges::any_of(boxes_, [&](const Eigen::AlignedBox3d& box) {
        if (!box.intersects(around)) return false;
        for (int i = 0; i < kPieces; ++i) {
            const double begin = static_cast<double>(i) / kPieces;
            const double end = static_cast<double>(i + 1) / kPieces;
            if (segmentMeets(from + begin * way, from + end * way, end * half, box)) return true;
        }
        return false;
    });
}

MapChange::MapChange(const FreeSpace& before, const AllowedRegion* region_before,
                     const FreeSpace& now, const AllowedRegion* region_now)
    : before_(before), now_(now) {
    // Cells are sorted by z, y and x.
    const auto order = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
        return std::tuple(a.z(), a.y(), a.x()) < std::tuple(b.z(), b.y(), b.x());
    };
    const std::size_t rooms = std::max(before.rooms().size(), now.rooms().size());
    for (std::size_t room = 0; room < rooms; ++room) {
        std::ranges::set_symmetric_difference(cellsOf(before, region_before, room),
                                              cellsOf(now, region_now, room),
                                              std::back_inserter(cells_), order);
    }
}

bool MapChange::at(const Eigen::Vector3d& place) const {
    return before_.stateAt(place) != now_.stateAt(place) ||
           before_.componentAt(place) != now_.componentAt(place);
}

bool MapChange::within(const Eigen::Vector3d& center, double distance_m) const {
    return std::ranges::any_of(cells_, [&](const Eigen::Vector3f& cell) {
        return (cell.cast<double>() - center).squaredNorm() <= distance_m * distance_m;
    });
}

bool isTouched(const SearchFootprint& footprint, const MovedObjects& moved, const MapChange& map,
               double camera_radius_m) {
    const double reach = camera_radius_m + SweptSphere::kMargin + kMovedTolerance_m;
    const double gap_reach = gapReach(camera_radius_m) + kMovedTolerance_m;
    Eigen::AlignedBox3d all = footprint.target;
    for (const SearchFootprint::Place& place : footprint.places) all.extend(place.position);
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(std::max(reach, gap_reach));
    const bool may_meet = moved.meet({all.min() - margin, all.max() + margin});
    for (const SearchFootprint::Place& place : footprint.places) {
        if (map.at(place.position)) return true;
        if (!may_meet) continue;
        if (moved.near(place.position, reach)) return true;
        if (place.cast_rays && moved.near(place.position, gap_reach)) return true;
        if (place.cast_rays && moved.cross(place.position, footprint.target)) return true;
    }
    return footprint.sampled_within_m >= 0.0 &&
           map.within(footprint.sampled_around, footprint.sampled_within_m);
}

}  // namespace dollytrack::planning
