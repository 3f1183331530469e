#include "planning/collision/allowed_region.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/floor_heights.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::planning {
namespace {

constexpr double kShortest_m = 0.001;

}  // namespace

AllowedRegion::AllowedRegion(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                             const std::vector<NoGoBox>& no_go, const FreeSpaceParams& params,
                             const BodyParams& body, double camera_radius_m)
    : no_go_(no_go),
      min_height_m_(params.min_height_m),
      max_height_m_(params.max_height_m),
      index_(no_go) {
    const FreeSpaceParams all;
    const bool has_height = body.camera_height_m > 0.0;
    if (has_height || min_height_m_ > all.min_height_m || max_height_m_ < all.max_height_m) {
        floors_ = std::make_unique<const FloorHeights>(scene, rays, free_space, camera_radius_m);
    }
    if (has_height) {
        levels_ = std::make_unique<const FloorLevels>(scene, rays, free_space, *floors_, no_go,
                                                      body, camera_radius_m);
        return;
    }
    if (!restricts()) return;
    cells_.resize(free_space.rooms().size());
    parallelFor(cells_.size(), [&](std::size_t room) {
        for (const Eigen::Vector3f& cell : free_space.cells(static_cast<int>(room))) {
            if (verdict(cell.cast<double>(), camera_radius_m) == Verdict::Legal) {
                cells_[room].push_back(cell);
            }
        }
    });
}

AllowedRegion::~AllowedRegion() = default;
AllowedRegion::AllowedRegion(AllowedRegion&&) noexcept = default;
AllowedRegion& AllowedRegion::operator=(AllowedRegion&&) noexcept = default;

Verdict AllowedRegion::verdict(const Eigen::Vector3d& center, double radius_m) const {
    if (index_.nearest(center, radius_m).box != NoGoIndex::kNone) return Verdict::NoGo;
    if (!floors_) return Verdict::Legal;
    if (levels_) {
        if (!levels_->isOnLevel(center)) return Verdict::HeightBand;
        if (levels_->clearance(center).free_m < SweptSphere::kMargin) return Verdict::InObstacle;
        return levels_->isReached(center) ? Verdict::Legal : Verdict::OutsideRoom;
    }
    const double height = heightOf(center);
    return height >= min_height_m_ && height <= max_height_m_ ? Verdict::Legal
                                                              : Verdict::HeightBand;
}

double AllowedRegion::noGoDistance(const Eigen::Vector3d& point) const {
    return index_.nearest(point, std::numeric_limits<double>::infinity()).distance_m;
}

const NoGoBox* AllowedRegion::boxAt(const Eigen::Vector3d& center, double radius_m) const {
    const std::size_t entered = index_.nearest(center, radius_m).box;
    return entered == NoGoIndex::kNone ? nullptr : &no_go_[entered];
}

bool AllowedRegion::bandHolds(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                              const Eigen::Vector3d& end, Eigen::Vector3d& where) const {
    if (levels_) {
        // Levels differ in height, so a curve whose control points share one height stays on its
        // level.
        constexpr double kSame_m = 1e-5;
        where = start;
        return levels_->isOnLevel(start) && std::abs(control.z() - start.z()) <= kSame_m &&
               std::abs(end.z() - start.z()) <= kSame_m;
    }
    return !floors_ || pieceHolds(start, control, end, where);
}

bool AllowedRegion::pieceHolds(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                               const Eigen::Vector3d& end, Eigen::Vector3d& where) const {
    // A Bezier curve lies in the convex hull of its control points.
    Eigen::AlignedBox3d box(start);
    box.extend(control);
    box.extend(end);
    const FloorHeights::Span floor = floors_->below(box);
    if (box.min().z() - floor.highest >= min_height_m_ &&
        box.max().z() - floor.lowest <= max_height_m_) {
        return true;
    }
    if (box.diagonal().norm() < kShortest_m) {
        where = start;
        return false;
    }
    const Eigen::Vector3d first = 0.5 * (start + control);
    const Eigen::Vector3d second = 0.5 * (control + end);
    const Eigen::Vector3d middle = 0.5 * (first + second);
    return pieceHolds(start, first, middle, where) && pieceHolds(middle, second, end, where);
}

Eigen::Vector3d AllowedRegion::inBand(const Eigen::Vector3d& place) const {
    if (!floors_) return place;
    if (levels_) return levels_->onLevel(place);
    const double floor = floors_->below(place);
    Eigen::Vector3d moved = place;
    // Stay slightly inside: heightOf() subtracts the floor again, with rounding errors.
    constexpr double kHair = 1e-9;
    moved.z() = std::clamp(place.z(), floor + min_height_m_ + kHair, floor + max_height_m_ - kHair);
    return moved;
}

double AllowedRegion::heightOf(const Eigen::Vector3d& place) const {
    return place.z() - floors_->below(place);
}

}  // namespace dollytrack::planning
