#include "planning/coverage/surface_goal.h"

#include "engine/jobs/parallel.h"
#include "planning/coverage/surface_progress.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

/// What a trajectory shows of one patch.
/// `coverable`: as SurfaceGoal::coverable of the patch.
PatchState shownBy(const Trajectory& trajectory, const SurfacePatch& patch, int coverable,
                   const SurfaceGoal& goal, const ViewEstimator& views) {
    const PatchVisibility visibility(views.rays(), surfaceRules());
    bool seen = false;
    DistinctDirections sharp;
    for (const TrajectoryFrame& frame : trajectory.frames) {
        const Eigen::Vector3d way = frame.pose.position - patch.point;
        const double distance = way.norm();
        const bool helps = distance <= goal.sharp_m && distance > 0.0 &&
                           sharp.adds(way / distance, goal.directions);
        if ((seen && !helps) || !views.inImage(frame.pose, patch.point) ||
            !visibility.reaches(frame.pose.position, patch)) {
            continue;
        }
        seen = true;
        if (helps) sharp.add(way / distance, goal.directions);
        if (sharp.count() == goal.directions) return PatchState::Covered;
    }
    if (!seen) return PatchState::Unseen;
    return sharp.count() >= coverable ? PatchState::SeenAtBest : PatchState::Seen;
}

}  // namespace

Result<SurfaceShare> measureSurface(const SurfaceGoal& goal, const ViewEstimator& views,
                                    const Trajectory& trajectory, const JobContext& job) {
    const std::vector<SurfacePatch>& patches = goal.surface.patches;
    SurfaceShare share;
    share.patch_m = goal.surface.spacing_m;
    share.patches = static_cast<int>(patches.size());
    share.measured.resize(patches.size());
    parallelFor(patches.size(), [&](std::size_t p) {
        if (job.cancelled()) return;
        share.measured[p] = {patches[p].point.cast<float>(), patches[p].normal.cast<float>(),
                             shownBy(trajectory, patches[p], goal.coverable[p], goal, views)};
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    for (std::size_t p = 0; p < patches.size(); ++p) {
        const bool covered = share.measured[p].state == PatchState::Covered;
        share.seen += share.measured[p].state != PatchState::Unseen ? 1 : 0;
        share.covered += covered ? 1 : 0;
        share.coverable += covered || goal.coverable[p] == goal.directions ? 1 : 0;
    }
    return share;
}

}  // namespace dollytrack::planning
