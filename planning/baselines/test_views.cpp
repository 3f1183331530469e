#include "planning/baselines/test_views.h"

#include "engine/geometry/ray_caster.h"
#include "planning/free_space/free_space.h"

namespace dollytrack::planning {
namespace {

constexpr int kTriesPerView = 2000;

struct DistanceBand {
    double least_m;
    double most_m;
};

std::vector<const Object*> targetsOf(const Scene& scene) {
    std::vector<const Object*> targets;
    for (const Object& object : scene.objects) {
        if (object.role == Role::Target) targets.push_back(&object);
    }
    return targets;
}

/// Whether a ray from the position to the object's centre hits that object, within the distances.
bool faces(const MappedScene& scene, const Eigen::Vector3d& place, const Object& object,
           const DistanceBand& band) {
    const Eigen::Vector3d way = object.box.center - place;
    const double distance = way.norm();
    if (distance < band.least_m || distance > band.most_m) return false;
    return scene.rays->cast(place, way / distance).object_id == object.id;
}

Result<PlannedMotion> viewsWithin(const MappedScene& scene, const PlanParams& params, int seed,
                                  const DistanceBand& band, const JobContext& job) {
    PlannedMotion motion;
    motion.trajectory.frame_interval_s = 1.0 / params.timing.frame_rate;
    const std::vector<const Object*> targets = targetsOf(*scene.scene);
    if (targets.empty()) return fail(ErrorCode::Failed, "The scene has no object to view.");
    const auto rooms = static_cast<std::uint32_t>(scene.free_space->rooms().size());
    for (int i = 0; i < frameBudget(params); ++i) {
        Random random(static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(i));
        for (int attempt = 0; attempt < kTriesPerView; ++attempt) {
            if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
            const Object& object =
                *targets[random.below(static_cast<std::uint32_t>(targets.size()))];
            const int room = static_cast<int>(random.below(rooms));
            const Eigen::Vector3d place = randomPlace(scene, room, random);
            if (!faces(scene, place, object, band)) continue;
            TrajectoryFrame frame;
            frame.path = static_cast<int>(motion.trajectory.frames.size());
            frame.time_s = frame.path * motion.trajectory.frame_interval_s;
            frame.component = room;
            frame.target_in_world = object.box.center;
            frame.pose = lookAt(place, frame.target_in_world);
            motion.trajectory.frames.push_back(frame);
            break;
        }
    }
    if (motion.trajectory.frames.empty()) {
        return fail(ErrorCode::Failed,
                    "No object is visible from a position within these distances.");
    }
    return motion;
}

}  // namespace

Result<PlannedMotion> planObjectFacing(const MappedScene& scene, const PlanParams& params, int seed,
                                       const JobContext& job) {
    return viewsWithin(scene, params, seed, {1.0, 3.0}, job);
}

Result<PlannedMotion> planCloseViews(const MappedScene& scene, const PlanParams& params, int seed,
                                     const JobContext& job) {
    return viewsWithin(scene, params, seed, {0.3, 1.0}, job);
}

}  // namespace dollytrack::planning
