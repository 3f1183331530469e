#include "planning/pipeline/follow_motion.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/mapped_scene.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/key_motion.h"
#include "planning/motions/motion_check.h"

#include <algorithm>
#include <limits>

namespace dollytrack::planning {
namespace {

constexpr double kMotionMade = 0.7;  // progress

/// Tests the moves of a path that begins at `start` for collisions, as repairs do, and for
/// clearance; incomplete if cancelled.
void testMoves(SmoothPath& path, const Eigen::Vector3d& start, const SweptSphere& sphere,
               const MotionCheck& check, const JobContext& job) {
    path.min_clearance_m = sphere.clearance(start, std::numeric_limits<double>::infinity());
    std::vector<SweepResult> sweeps(path.pieces.size());
    parallelFor(sweeps.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        const Eigen::Vector3d& from = path.pieces[i].start;
        const Eigen::Vector3d& to = path.pieces[i].end;
        sweeps[i] = sphere.segment(from, to);
        if (!sweeps[i].free) sweeps[i].free = check.isFree(from, to);
    });
    // A path that stays at one place has no moves.
    if (sweeps.empty() && !check.isFree(start)) path.collisions = 1;
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        path.pieces[i].collides = !sweeps[i].free;
        path.collisions += sweeps[i].free ? 0 : 1;
        path.min_clearance_m = std::min(path.min_clearance_m, sweeps[i].min_clearance_m);
    }
}

}  // namespace

PlanParams paramsForMotion(PlanParams params) {
    const PlanParams usual;
    params.timing.max_frames = usual.timing.max_frames;
    params.timing.max_repeat_rate = usual.timing.max_repeat_rate;
    params.timing.duration_s = usual.timing.duration_s;
    params.timing.keep_frame_rate = usual.timing.keep_frame_rate;
    params.path = usual.path;
    params.constraints.loop = usual.constraints.loop;
    params.constraints.anchors = usual.constraints.anchors;
    params.constraints.rooms = usual.constraints.rooms;
    params.gaze.view_mix = 0.0;
    params.repair.repair_rounds = 0;
    params.repair.drop_low_frames = false;
    return params;
}

std::vector<std::string> withoutEffectOnMotion(const PlanParams& params) {
    PlanParams used = paramsForMotion(params);
    used.gaze = params.gaze;  // view_mix is reset, too, but its default is not 0
    std::vector<std::string> names;
    for (auto& [name, value] : changedFields(params, used)) names.push_back(std::move(name));
    return names;
}

Result<FollowedMotion> followMotion(const GivenMotion& motion, const MappedScene& scene,
                                    const TimingParams& timing, const JobContext& job) {
    FollowedMotion followed;
    RepairedTrajectory& made = followed.made;
    if (motion.keys.empty()) {
        made.trajectory = trajectoryOf(motion);
    } else {
        auto moved =
            moveThroughKeys(scene, timing, motion.keys, job.stage(0.0, kMotionMade, "key frames"));
        if (!moved) return tl::unexpected(std::move(moved.error()));
        made.trajectory = std::move(moved->trajectory);
        followed.keys = std::move(moved->passed);
    }
    int component = 0;  // outside of all rooms, that of the frame before
    for (TrajectoryFrame& frame : made.trajectory.frames) {
        const Eigen::Vector3d& position = frame.pose.position;
        if (const int here = scene.free_space->componentAt(position); here >= 0) component = here;
        frame.component = component;
        if (frame.path == static_cast<int>(made.paths.size())) {
            made.paths.push_back({component, 0, {}});
            made.smooth_paths.emplace_back().component = component;
        }
        SmoothPath& smooth = made.smooth_paths.back();
        std::vector<PathVertex>& vertices = made.paths.back().vertices;
        if (!vertices.empty()) {
            const Eigen::Vector3d& from = vertices.back().position;
            smooth.append(from, 0.5 * (from + position), position, false);
        }
        if (vertices.empty() || vertices.back().position != position) {
            vertices.push_back({position, -1});
        }
        frame.arc_m = smooth.length_m;
    }
    const JobContext tests = job.stage(kMotionMade, 1.0, "collision tests");
    const MotionCheck check(scene);
    for (std::size_t i = 0; i < made.paths.size() && !job.cancelled(); ++i) {
        tests.report(static_cast<double>(i) / static_cast<double>(made.paths.size()));
        testMoves(made.smooth_paths[i], made.paths[i].vertices.front().position, *scene.sphere,
                  check, job);
    }
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    return followed;
}

}  // namespace dollytrack::planning
