#include "planning/baselines/wall_stare.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace dollytrack::planning {
namespace {

constexpr int kViewsTried = 2000;
constexpr int kRaysAcross = 7;
constexpr double kSway_m = 0.15;
constexpr int kFramesOfSway = 12;

struct BareView {
    int on_wall = -1;         // rays that hit the structure object which fills most of the view
    double distance_m = 0.0;  // of the centre ray
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    Eigen::Vector3d towards = Eigen::Vector3d::UnitX();

    [[nodiscard]] bool isBarerThan(const BareView& other) const {
        if (on_wall != other.on_wall) return on_wall > other.on_wall;
        return distance_m < other.distance_m;
    }
};

BareView lookAtWall(const MappedScene& scene, const Eigen::Vector3d& place, double yaw) {
    BareView view;
    view.place = place;
    view.towards = {std::cos(yaw), std::sin(yaw), 0.0};
    view.distance_m = scene.rays->cast(place, view.towards).distance;
    const Pose pose = lookAt(place, place + view.towards);
    const Intrinsics& lens = scene.views->intrinsics();
    std::map<int, int> met;  // rays by structure object
    for (int i = 0; i < kRaysAcross * kRaysAcross; ++i) {
        const double x = (i % kRaysAcross + 0.5) / kRaysAcross * lens.width;
        const double y = (i / kRaysAcross + 0.5) / kRaysAcross * lens.height;
        const int id = scene.rays->cast(place, pose.rotation * lens.unproject(x, y)).object_id;
        if (id != 0 && scene.scene->object(id).role == Role::Structure) ++met[id];
    }
    view.on_wall = 0;
    for (const auto& [id, rays] : met) view.on_wall = std::max(view.on_wall, rays);
    return view;
}

}  // namespace

Result<PlannedMotion> planWallStare(const MappedScene& scene, const PlanParams& params, int seed,
                                    const JobContext& job) {
    Random random(static_cast<std::uint64_t>(seed));
    BareView best;
    for (int i = 0; i < kViewsTried; ++i) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        const Eigen::Vector3d place = randomPlace(scene, 0, random);
        const BareView view = lookAtWall(scene, place, random.uniform(0.0, 2.0 * std::numbers::pi));
        if (view.isBarerThan(best)) best = view;
    }
    PlannedMotion motion;
    motion.trajectory.frame_interval_s = 1.0 / params.timing.frame_rate;
    const Eigen::Vector3d aside = best.towards.cross(Eigen::Vector3d::UnitZ());
    for (int i = 0; i < frameBudget(params); ++i) {
        TrajectoryFrame frame;
        frame.time_s = i * motion.trajectory.frame_interval_s;
        const double sway =
            kSway_m * std::sin(2.0 * std::numbers::pi * static_cast<double>(i) / kFramesOfSway);
        const Eigen::Vector3d place = best.place + sway * aside;
        frame.component = 0;
        const Eigen::Vector3d from = scene.sphere->fits(place) ? place : best.place;
        frame.target_in_world = from + best.towards;
        frame.pose = lookAt(from, frame.target_in_world);
        motion.trajectory.frames.push_back(frame);
    }
    return motion;
}

}  // namespace dollytrack::planning
