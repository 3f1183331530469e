#include "planning/viewpoints/fixed_points.h"

#include "engine/geometry/ray_caster.h"
#include "planning/free_space/free_space.h"
#include "planning/visibility/view_estimator.h"

namespace dollytrack::planning {
namespace {

constexpr double kLooksAt_m = 2.0;  // distance of the target of a view that hits nothing
constexpr double kFarthest_m = 10.0;

}  // namespace

Eigen::Vector3d lookedAt(const Pose& pose, const ViewEstimator& views) {
    const RayHit hit =
        views.rays().cast(pose.position, pose.forward(), kFarthest_m, views.nearDistance());
    return pose.position + (hit.object_id != 0 ? hit.distance : kLooksAt_m) * pose.forward();
}

void addFixedPoint(const Pose& pose, const PlanningEnvironment& environment,
                   Viewpoints& viewpoints) {
    ObservationPoint target;
    target.position = lookedAt(pose, environment.views);
    target.direction = -pose.forward();
    PositionPoint point;
    point.observation_point = static_cast<int>(viewpoints.observation_points.size());
    point.pose = pose;
    point.component = environment.free_space.componentAt(pose.position);
    point.fixed = true;
    ViewpointSearch search;
    search.position_point = static_cast<int>(viewpoints.position_points.size());
    viewpoints.observation_points.push_back(std::move(target));
    viewpoints.searches.push_back(std::move(search));
    viewpoints.position_points.push_back(std::move(point));
}

}  // namespace dollytrack::planning
