#include "planning/coverage/surface_goal.h"

#include "engine/jobs/parallel.h"
#include "planning/coverage/surface_progress.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

/// What a trajectory shows of one patch.
struct ShownPatch {
    bool seen = false;
    bool covered = false;
};

ShownPatch shownBy(const Trajectory& trajectory, const SurfacePatch& patch, const SurfaceGoal& goal,
                   const ViewEstimator& views) {
    const PatchVisibility visibility(views.rays(), surfaceRules());
    ShownPatch shown;
    DistinctDirections sharp;
    for (const TrajectoryFrame& frame : trajectory.frames) {
        const Eigen::Vector3d way = frame.pose.position - patch.point;
        const double distance = way.norm();
        const bool helps = distance <= goal.sharp_m && distance > 0.0 &&
                           sharp.adds(way / distance, goal.directions);
        if ((shown.seen && !helps) || !views.inImage(frame.pose, patch.point) ||
            !visibility.reaches(frame.pose.position, patch)) {
            continue;
        }
        shown.seen = true;
        if (helps) sharp.add(way / distance, goal.directions);
        shown.covered = sharp.count() == goal.directions;
        if (shown.covered) break;
    }
    return shown;
}

}  // namespace

Result<SurfaceShare> measureSurface(const SurfaceGoal& goal, const ViewEstimator& views,
                                    const Trajectory& trajectory, const JobContext& job) {
    const std::vector<SurfacePatch>& patches = goal.surface.patches;
    std::vector<ShownPatch> shown(patches.size());
    parallelFor(patches.size(), [&](std::size_t p) {
        if (!job.cancelled()) shown[p] = shownBy(trajectory, patches[p], goal, views);
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    SurfaceShare share;
    share.patch_m = goal.surface.spacing_m;
    share.patches = static_cast<int>(patches.size());
    for (std::size_t p = 0; p < patches.size(); ++p) {
        share.seen += shown[p].seen ? 1 : 0;
        share.covered += shown[p].covered ? 1 : 0;
        share.coverable += shown[p].covered || goal.coverable[p] == goal.directions ? 1 : 0;
    }
    return share;
}

}  // namespace dollytrack::planning
