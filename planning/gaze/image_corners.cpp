#include "planning/gaze/image_corners.h"

#include "engine/jobs/parallel.h"
#include "engine/plan/frame_series.h"
#include "planning/gaze/corner_panorama.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>

namespace dollytrack::planning {

Result<std::vector<double>> estimateImageCorners(const ViewEstimator& views,
                                                 const TextureCorners& textures,
                                                 const Trajectory& trajectory,
                                                 const JobContext& job) {
    std::vector<double> corners(trajectory.frames.size());
    parallelFor(corners.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        const Pose& pose = trajectory.frames[i].pose;
        corners[i] =
            CornerPanorama(views, textures, pose.position, pose.forward()).corners(pose.rotation);
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    return corners;
}

std::optional<double> trackableRate(const std::vector<double>& corners) {
    if (corners.empty()) return std::nullopt;
    const auto enough =
        std::ranges::count_if(corners, [](double count) { return count >= kTrackableCorners; });
    return static_cast<double>(enough) / static_cast<double>(corners.size());
}

}  // namespace dollytrack::planning
