#include "engine/plan/frame_series.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"

#include <numbers>
#include <set>
#include <utility>

namespace dollytrack {
namespace {

void measureMotion(const Trajectory& trajectory, FrameSeries& series) {
    const auto& frames = trajectory.frames;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const double step_s = frames[i].time_s - frames[i - 1].time_s;
        if (!continuesPath(trajectory, i) || step_s <= 0.0) continue;
        const double step = (frames[i].pose.position - frames[i - 1].pose.position).norm();
        const double turn = angleBetween(frames[i].pose.rotation, frames[i - 1].pose.rotation);
        series.speed_mps[i] = step / step_s;
        series.turn_dps[i] = turn * 180.0 / std::numbers::pi / step_s;
    }
}

void countViews(const std::vector<std::vector<ObjectView>>& views,
                const std::vector<ObjectCapture>& captures, FrameSeries& series) {
    std::set<int> open;  // captured objects that no frame so far captures
    for (const ObjectCapture& capture : captures) {
        if (capture.captured) open.insert(capture.object_id);
    }
    int so_far = 0;
    for (std::size_t i = 0; i < series.size(); ++i) {
        if (i < views.size()) {
            for (const ObjectView& view : views[i]) {
                series.in_view[i] += view.visible_px > 0.0;
                series.captured[i] += isCaptured(view);
                series.well_captured[i] += isWellCaptured(view);
                if (isCaptured(view) && open.erase(view.object_id) > 0) {
                    series.newly_captured[i].push_back(view.object_id);
                }
            }
        }
        so_far += static_cast<int>(series.newly_captured[i].size());
        series.captured_so_far[i] = so_far;
    }
}

}  // namespace

double clearanceAt(const RayCaster& rays, const Eigen::Vector3d& position) {
    // Short distances first: most frames are near a surface, and long queries visit many more
    // triangles.
    for (const double reach : {0.5, 2.0}) {
        const ClosestPoint closest = rays.closest(position, reach);
        if (closest.object_id != 0) return closest.distance;
    }
    return rays.closest(position).distance;
}

FrameSeries measureFrames(const Trajectory& trajectory,
                          const std::vector<std::vector<ObjectView>>& views,
                          const std::vector<ObjectCapture>& captures, std::vector<double> scores,
                          const RayCaster& rays) {
    const std::size_t count = trajectory.frames.size();
    FrameSeries series;
    series.clearance_m.resize(count);
    series.speed_mps.resize(count);
    series.turn_dps.resize(count);
    series.in_view.resize(count);
    series.captured.resize(count);
    series.well_captured.resize(count);
    series.captured_so_far.resize(count);
    series.newly_captured.resize(count);
    parallelFor(count, [&](std::size_t i) {
        series.clearance_m[i] = clearanceAt(rays, trajectory.frames[i].pose.position);
    });
    measureMotion(trajectory, series);
    countViews(views, captures, series);
    series.score = std::move(scores);
    return series;
}

}  // namespace dollytrack
