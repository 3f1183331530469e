#include "planning/analysis/frame_quality.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "planning/coverage/surface_views.h"
#include "planning/gaze/image_corners.h"
#include "planning/gaze/texture_corners.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr int kOverlapAcross = 16, kOverlapDown = 12;  // rays over an image
constexpr double kNoHit_m = 1e3;                       // where a ray hits nothing

Result<std::vector<double>> measureOverlaps(const ViewEstimator& views,
                                            const Trajectory& trajectory, const JobContext& job) {
    const std::vector<TrajectoryFrame>& frames = trajectory.frames;
    std::vector<double> overlaps(frames.size(), 1.0);
    parallelFor(frames.size(), [&](std::size_t i) {
        if (!continuesPath(trajectory, i) || job.cancelled()) return;
        overlaps[i] = imageOverlap(views, frames[i].pose, frames[i - 1].pose);
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    return overlaps;
}

}  // namespace

double imageOverlap(const ViewEstimator& views, const Pose& pose, const Pose& before) {
    const Intrinsics& lens = views.intrinsics();
    std::vector<RayCaster::BundleRay> rays;
    for (int y = 0; y < kOverlapDown; ++y) {
        for (int x = 0; x < kOverlapAcross; ++x) {
            rays.push_back({pose.rotation * lens.unproject(lens.width * (x + 0.5) / kOverlapAcross,
                                                           lens.height * (y + 0.5) / kOverlapDown)
                                                .normalized()});
        }
    }
    std::vector<RayHit> hits;
    views.rays().castBundle(pose.position, rays, views.nearDistance(), hits);
    std::vector<RayCaster::BundleRay> back;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const double distance = hits[i].object_id == 0 ? kNoHit_m : hits[i].distance;
        const Eigen::Vector3d point = pose.position + distance * rays[i].direction;
        if (!views.inImage(before, point)) continue;
        const Eigen::Vector3d way = point - before.position;
        back.push_back({way, static_cast<float>(1.0 - PatchVisibility::kReached_m / way.norm())});
    }
    std::vector<RayHit> in_front;
    views.rays().castBundle(before.position, back, 0.0, in_front);
    const auto shared = std::ranges::count(in_front, 0, &RayHit::object_id);
    return static_cast<double>(shared) / static_cast<double>(rays.size());
}

Result<FrameQuality> measureFrameQuality(const PlanningEnvironment& environment,
                                         const PlanParams& params, const Plan& plan,
                                         const JobContext& job) {
    FrameQuality quality;
    auto overlap =
        measureOverlaps(environment.views, plan.trajectory, job.stage(0.0, 0.2, "overlap"));
    if (!overlap) return tl::unexpected(std::move(overlap.error()));
    quality.overlap = std::move(*overlap);
    job.report(0.2);
    quality.image_corners = plan.series.image_corners;
    if (quality.image_corners.size() != plan.trajectory.frames.size()) {
        auto corners =
            estimateImageCorners(environment.views, TextureCorners(environment.views.scene()),
                                 plan.trajectory, job.stage(0.2, 0.5, "image corners"));
        if (!corners) return tl::unexpected(std::move(corners.error()));
        quality.image_corners = std::move(*corners);
    }
    job.report(0.5);
    if (plan.surface) {
        quality.surface = *plan.surface;
        return quality;
    }
    return findSurfaceViews(environment, params, {}, 0, job.stage(0.5, 0.8, "surface"))
        .and_then([&](const SurfaceViews& found) {
            return measureSurface(found.goal, environment.views, plan.trajectory,
                                  job.stage(0.8, 1.0, "surface"));
        })
        .map([&](SurfaceShare&& surface) {
            quality.surface = std::move(surface);
            return std::move(quality);
        });
}

}  // namespace dollytrack::planning
