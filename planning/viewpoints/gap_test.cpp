#include "planning/viewpoints/gap_test.h"

#include "planning/collision/swept_sphere.h"
#include "planning/visibility/facing_normal.h"
#include "planning/visibility/scanned_surfaces.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <vector>

namespace dollytrack::planning {
namespace {

// Small cameras are used in small scenes, whose rooms must not count as gaps.
constexpr double kMostReach_m = 0.6;
constexpr double kReachInRadii = 6.0;
constexpr int kGapDirections = 96;
constexpr int kGapLines = kGapDirections / 2;  // lines along the upper half of the directions
constexpr int kGapLinesNeeded = kGapLines / 3;
constexpr double kFacing = -0.5;  // largest cosine between the normals of facing surfaces
// Nearest surface as a share of the reach: for a third of the lines to be within reach, the gap
// must be no wider than 2/3 of it.
constexpr double kNearestWall = 1.0 / 3.0;

bool endsBetween(const ViewEstimator& views, const Eigen::Vector3d& place,
                 const Eigen::Vector3d& direction, double reach) {
    const RayHit ahead = views.rays().cast(place, direction, reach);
    if (ahead.object_id == 0) return false;
    const RayHit behind = views.rays().cast(place, -direction, reach - ahead.distance);
    return behind.object_id != 0 &&
           facingNormal(views.scene(), ahead, direction)
                   .dot(facingNormal(views.scene(), behind, -direction)) < kFacing;
}

}  // namespace

double gapReach(double camera_radius_m) {
    return std::min(kMostReach_m, kReachInRadii * camera_radius_m);
}

bool isInGap(const SweptSphere& sphere, const ViewEstimator& views, const Eigen::Vector3d& place) {
    const double reach = gapReach(sphere.radius());
    const double nearest = kNearestWall * reach;
    if (sphere.clearance(place, nearest) >= nearest) return false;
    static const std::vector<Eigen::Vector3d> directions = directionsOnSphere(kGapDirections);
    int found = 0;
    for (int i = 0; i < kGapLines; ++i) {
        found += endsBetween(views, place, directions[i], reach) ? 1 : 0;
        if (found >= kGapLinesNeeded) return true;
        if (found + kGapLines - i - 1 < kGapLinesNeeded) return false;
    }
    return false;
}

}  // namespace dollytrack::planning
