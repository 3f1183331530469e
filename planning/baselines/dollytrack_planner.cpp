#include "planning/baselines/dollytrack_planner.h"

#include "engine/plan/plan.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/pipeline/pipeline.h"
#include "planning/smoothing/smooth_path.h"
#include "planning/timing/frame_moves.h"
#include "planning/timing/time_trajectory.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {
namespace {

constexpr double kFineStep = 0.01;  // m; chords this short are within 0.1 mm of the curves

/// The motion between kept frames, along each smoothed path and off it where the camera shakes.
std::vector<std::vector<Eigen::Vector3d>> waysAlong(const std::vector<SmoothPath>& paths,
                                                    const Trajectory& trajectory) {
    const std::size_t kept = trajectory.frames.size();
    const std::vector<std::size_t> order = motionOrder(trajectory);
    std::vector<std::vector<Eigen::Vector3d>> between(kept);
    std::size_t i = 0;  // the last kept frame
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
        if (order[k] < kept) i = order[k];
        const TrajectoryFrame& from = motionFrame(trajectory, order[k]);
        const TrajectoryFrame& to = motionFrame(trajectory, order[k + 1]);
        if (from.path != to.path || from.path != trajectory.frames[i].path) continue;
        for (const auto& piece : moveBetween(paths[from.path], from, to)) {
            const double longest =
                (piece.control - piece.start).norm() + (piece.end - piece.control).norm();
            const int steps = std::max(1, static_cast<int>(std::ceil(longest / kFineStep)));
            for (int j = 1; j <= steps; ++j) {
                between[i].push_back(piece.at(static_cast<double>(j) / steps));
            }
        }
        // The next kept frame itself.
        if (order[k + 1] < kept && !between[i].empty()) between[i].pop_back();
    }
    return between;
}

PlannedMotion motionAlong(const std::vector<SmoothPath>& paths, Trajectory trajectory) {
    PlannedMotion motion;
    motion.between = waysAlong(paths, trajectory);
    motion.trajectory = std::move(trajectory);
    int corners = 0;
    int collisions = 0;
    for (const SmoothPath& path : paths) {
        for (const SmoothPath::Piece& piece : path.pieces) corners += piece.curved ? 1 : 0;
        collisions += path.corner_collisions;
    }
    motion.corner_collision_rate = corners > 0 ? static_cast<double>(collisions) / corners : 0.0;
    return motion;
}

Result<std::shared_ptr<const Plan>> runPipeline(const MappedScene& scene, PlanParams params,
                                                int seed, const JobContext& job) {
    params.seed = seed;
    params.timing.max_frames = frameBudget(params);
    PlanEdits edits = scene.edits;
    edits.motion = {};
    return Pipeline(scene.scene).run(params, edits, job);
}

}  // namespace

PlannedMotion plannedMotionOf(const Plan& plan) {
    PlannedMotion motion = motionAlong(plan.smooth_paths, plan.trajectory);
    motion.plan_ms = plan.plan_ms;
    return motion;
}

Result<PlannedMotion> smoothAsThePaper(const MappedScene& scene, const Plan& plan,
                                       const PlanParams& params) {
    const PitchBand pitch = pitchBand(params.constraints);
    const PlanningEnvironment environment{*scene.views, *scene.free_space, *scene.sphere, pitch};
    std::vector<SmoothPath> paths;
    for (const CameraPath& path : plan.paths) {
        paths.push_back(smoothBlindly(path, params.smoothing.corner_distance_m, environment));
    }
    return timeTrajectory(paths, plan.position_points, plan.observation_points, params.timing,
                          pitch, headingLimit(params.body))
        .map([&](Trajectory&& trajectory) {
            PlannedMotion motion = motionAlong(paths, std::move(trajectory));
            motion.plan_ms = plan.plan_ms;
            return motion;
        });
}

Result<PlannedMotion> planWithDollytrack(const MappedScene& scene, const PlanParams& params,
                                         int seed, const JobContext& job) {
    return runPipeline(scene, params, seed, job).map([](const auto& plan) {
        return plannedMotionOf(*plan);
    });
}

Result<PlannedMotion> planPaperSmoothing(const MappedScene& scene, const PlanParams& params,
                                         int seed, const JobContext& job) {
    PlanParams as_paper = params;
    as_paper.timing.max_frames = frameBudget(params);
    as_paper.viewpoints.fill = usedFill(params);
    as_paper.gaze = {0.0, Trackability::Off};  // without context views
    return runPipeline(scene, as_paper, seed, job).and_then([&](const auto& plan) {
        return smoothAsThePaper(scene, *plan, as_paper);
    });
}

}  // namespace dollytrack::planning
