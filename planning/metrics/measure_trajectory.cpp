#include "engine/jobs/parallel.h"
#include "planning/collision/path_clearance.h"
#include "planning/collision/swept_sphere.h"
#include "planning/metrics/estimate_captures.h"
#include "planning/metrics/minimum_clearance.h"
#include "planning/visibility/shown_surface.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {

Result<TrajectoryMetrics> measureTrajectory(const ViewEstimator& views,
                                            const std::vector<SmoothPath>& paths,
                                            const Trajectory& trajectory, const SweptSphere& sphere,
                                            const RayCaster& rays, const JobContext& job) {
    TrajectoryMetrics metrics;
    int corners = 0;
    int collisions = 0;
    for (const SmoothPath& path : paths) {
        metrics.path_length_m += path.length_m;
        corners += static_cast<int>(
            std::count_if(path.pieces.begin(), path.pieces.end(),
                          [](const SmoothPath::Piece& piece) { return piece.curved; }));
        collisions += path.corner_collisions;
    }
    if (corners > 0) metrics.corner_collision_rate = static_cast<double>(collisions) / corners;

    const std::size_t count = trajectory.frames.size();
    if (count == 0) return metrics;
    std::vector<char> collides(count, 0);
    parallelFor(count, [&](std::size_t i) {
        const Eigen::Vector3d& position = trajectory.frames[i].pose.position;
        collides[i] = sphere.clearance(position, sphere.radius()) < sphere.radius();
    });
    std::vector<char> cuts(count, 0);
    parallelFor(count, [&](std::size_t i) {
        if (!continuesPath(trajectory, i)) return;
        const Eigen::Vector3d& from = trajectory.frames[i - 1].pose.position;
        const Eigen::Vector3d& to = trajectory.frames[i].pose.position;
        const SweepResult sweep = sphere.segment(from, to);
        // SweptSphere also rejects contact without overlap; only overlap counts as a hit.
        cuts[i] = !sweep.free &&
                  (sweep.reason != Verdict::InObstacle ||
                   smallestClearance(rays, {from, to}, sphere.radius(), {}) < sphere.radius());
    });
    metrics.straight_lines_that_hit = static_cast<int>(std::count(cuts.begin(), cuts.end(), 1));
    metrics.minimum_clearance = findMinimumClearance(paths, trajectory, rays);
    metrics.motion = measureMotion(trajectory);
    metrics.frame_collision_rate =
        static_cast<double>(std::count(collides.begin(), collides.end(), 1)) /
        static_cast<double>(count);
    return measureShownSurface(views, trajectory, job).map([&](const ShownSurface& shown) {
        metrics.repeat_rate = shown.repeatRate();
        metrics.object_pixels = shown.object_pixels;
        return metrics;
    });
}

}  // namespace dollytrack::planning
