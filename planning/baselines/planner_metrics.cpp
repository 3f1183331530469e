#include "planning/baselines/planner_metrics.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "engine/math/quantile.h"
#include "engine/plan/frame_quality.h"
#include "engine/plan/motion_metrics.h"
#include "planning/collision/path_clearance.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/gaze/image_corners.h"
#include "planning/metrics/estimate_captures.h"
#include "planning/visibility/shown_surface.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dollytrack::planning {
namespace {

double lengthOf(const std::vector<Eigen::Vector3d>& way) {
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) length += (way[i + 1] - way[i]).norm();
    return length;
}

void setMedianAndMax(std::vector<double> values, std::optional<double>& middle,
                     std::optional<double>& max) {
    if (values.empty()) return;
    max = *std::max_element(values.begin(), values.end());
    middle = median(std::move(values));
}

void measureMotion(const PlannedMotion& motion, const std::vector<double>& lengths,
                   PlannerMetrics& result) {
    const auto& frames = motion.trajectory.frames;
    std::vector<double> speeds;
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        const double seconds = frames[i + 1].time_s - frames[i].time_s;
        if (continuesPath(motion.trajectory, i + 1) && seconds > 0.0) {
            speeds.push_back(lengths[i] / seconds);
        }
    }
    if (speeds.empty()) return;
    setMedianAndMax(std::move(speeds), result.speed_median_mps, result.speed_max_mps);
    const MotionMetrics all = dollytrack::measureMotion(motion.trajectory);
    result.turn_median_dps = all.turn_dps.median;
    result.turn_max_dps = all.turn_dps.max;
    result.jerk_median_mps3 = all.jerk_mps3.median;
    result.jerk_max_mps3 = all.jerk_mps3.max;
}

void measureCollisions(const MappedScene& scene, const PlannedMotion& motion, const JobContext& job,
                       std::vector<double>& lengths, PlannerMetrics& result) {
    const auto& frames = motion.trajectory.frames;
    const double radius = scene.sphere->radius();
    std::vector<double> at_frame(frames.size());
    std::vector<double> on_way(frames.size(), std::numeric_limits<double>::infinity());
    std::vector<char> moves(frames.size(), 0);
    lengths.assign(frames.size(), 0.0);
    parallelFor(frames.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        at_frame[i] = clearanceAt(*scene.rays, frames[i].pose.position);
        const auto way = wayToNext(motion, i);
        if (way.empty()) return;
        moves[i] = 1;
        lengths[i] = lengthOf(way);
        on_way[i] = smallestClearance(*scene.rays, way, radius, job);
    });
    const auto hits = [&](const std::vector<double>& clearances) {
        return static_cast<double>(std::count_if(clearances.begin(), clearances.end(),
                                                 [&](double c) { return c < radius; }));
    };
    const auto outside = std::count_if(frames.begin(), frames.end(), [&](const auto& frame) {
        return scene.free_space->stateAt(frame.pose.position) != CellState::Free;
    });
    const auto count = static_cast<double>(frames.size());
    result.frame_collision_rate = hits(at_frame) / count;
    result.outside_rate = static_cast<double>(outside) / count;
    result.min_clearance_m = std::min(*std::min_element(at_frame.begin(), at_frame.end()),
                                      *std::min_element(on_way.begin(), on_way.end()));
    const auto moving = std::count(moves.begin(), moves.end(), 1);
    if (moving == 0) return;
    result.move_collision_rate = hits(on_way) / static_cast<double>(moving);
    double length = 0.0;
    for (const double one : lengths) length += one;
    result.path_length_m = length;
}

}  // namespace

Result<PlannerMetrics> measurePlannedMotion(const MappedScene& scene, const PlannedMotion& motion,
                                            const JobContext& job) {
    PlannerMetrics result;
    result.frames = static_cast<int>(motion.trajectory.frames.size());
    result.corner_collision_rate = motion.corner_collision_rate;
    result.plan_ms = motion.plan_ms;
    auto estimate = estimateCaptures(*scene.views, motion.trajectory, job);
    if (!estimate) return tl::unexpected(std::move(estimate.error()));
    result.captures = summarize(*scene.scene, estimate->captures);
    result.objects = std::move(estimate->captures);
    if (motion.trajectory.frames.empty()) return result;
    std::vector<double> lengths;
    measureCollisions(scene, motion, job, lengths, result);
    if (job.cancelled())
        return fail(ErrorCode::Cancelled, "Measuring the trajectory was cancelled.");
    measureMotion(motion, lengths, result);
    const auto corners =
        estimateImageCorners(*scene.views, *scene.texture_corners, motion.trajectory, job);
    if (!corners) return tl::unexpected(corners.error());
    result.trackable_rate = trackableRate(*corners);
    return measureShownSurface(*scene.views, motion.trajectory, job)
        .map([&](const ShownSurface& shown) {
            result.repeat_rate = shown.repeatRate();
            result.object_pixels = shown.object_pixels;
            return result;
        });
}

}  // namespace dollytrack::planning
