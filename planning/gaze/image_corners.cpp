#include "planning/gaze/image_corners.h"

#include "engine/jobs/parallel.h"
#include "engine/plan/frame_series.h"
#include "planning/gaze/corner_panorama.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

constexpr double kCornersOfFullWeight = 2.0 * kTrackableCorners;

double cornersIn(const ViewEstimator& views, const TextureCorners& textures, const Pose& pose) {
    return CornerPanorama(views, textures, pose.position, pose.forward()).corners(pose.rotation);
}

}  // namespace

Result<std::vector<double>> estimateImageCorners(const ViewEstimator& views,
                                                 const TextureCorners& textures,
                                                 const Trajectory& trajectory,
                                                 const JobContext& job) {
    std::vector<double> corners(trajectory.frames.size());
    parallelFor(corners.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        corners[i] = cornersIn(views, textures, trajectory.frames[i].pose);
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    return corners;
}

void weighByCorners(const ViewEstimator& views, const TextureCorners& textures,
                    const std::vector<PositionPoint>& position_points,
                    std::vector<double>& object_weights) {
    constexpr double kLeastWeight = 0.1;
    std::vector<double> shares(position_points.size());
    parallelFor(shares.size(), [&](std::size_t i) {
        const double corners = cornersIn(views, textures, position_points[i].pose);
        shares[i] = std::clamp(corners / kCornersOfFullWeight, kLeastWeight, 1.0);
    });
    const std::size_t objects = views.scene().objects.size();
    std::vector<double> best(objects, 0.0);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        for (const int id : position_points[i].captured) {
            best[id - 1] = std::max(best[id - 1], shares[i]);
        }
    }
    object_weights.resize(objects, 1.0);
    for (std::size_t i = 0; i < objects; ++i) {
        if (best[i] > 0.0) object_weights[i] *= best[i];
    }
}

std::optional<double> trackableRate(const std::vector<double>& corners) {
    if (corners.empty()) return std::nullopt;
    const auto enough =
        std::ranges::count_if(corners, [](double count) { return count >= kTrackableCorners; });
    return static_cast<double>(enough) / static_cast<double>(corners.size());
}

}  // namespace dollytrack::planning
