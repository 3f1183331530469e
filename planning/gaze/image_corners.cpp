#include "planning/gaze/image_corners.h"

#include "engine/jobs/parallel.h"
#include "engine/plan/frame_quality.h"
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
    // A SLAM program tracks a frame by corners that it knows already. Of ten trajectories,
    // ORB-SLAM2 lost the one with 11 corners shared over five frames; the others share at least 65.
    constexpr double kMostPerSharedCorner = 1.5;
    constexpr std::size_t kFramesBack = 5;
    const std::vector<TrajectoryFrame>& frames = trajectory.frames;
    std::vector<double> corners(frames.size());
    parallelFor(corners.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        std::size_t back = std::min(i, kFramesBack);
        while (frames[i - back].path != frames[i].path) --back;
        const Pose& pose = frames[i].pose;
        const CornerPanorama panorama(views, textures, pose.position, pose.forward());
        corners[i] = std::min(
            panorama.corners(pose.rotation),
            kMostPerSharedCorner * panorama.cornersAlsoIn(frames[i - back].pose, pose.rotation));
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    return corners;
}

void weighByCorners(const ViewEstimator& views, const TextureCorners& textures,
                    const std::vector<PositionPoint>& position_points,
                    std::vector<double>& object_weights, const JobContext& job) {
    constexpr double kLeastWeight = 0.1;
    std::vector<double> shares(position_points.size());
    parallelFor(shares.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
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

std::vector<int> pointsAmongBareViews(const Trajectory& trajectory,
                                      const std::vector<double>& corners,
                                      const std::vector<PositionPoint>& position_points) {
    /// A key frame, and the numbers of frames with few corners up to the key frames around it.
    struct Stop {
        int point = -1;
        int bare_before = 0;
        int bare_after = 0;
    };
    std::vector<Stop> stops;
    bool same_path = false;
    int bare = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const TrajectoryFrame& frame = trajectory.frames[i];
        if (!continuesPath(trajectory, i)) {
            same_path = false;
            bare = 0;
        }
        if (isUntrackable(corners[i])) ++bare;
        if (same_path) stops.back().bare_after = bare;
        if (frame.position_point < 0) continue;
        stops.push_back({frame.position_point, bare, 0});
        same_path = true;
        bare = isUntrackable(corners[i]) ? 1 : 0;
    }
    std::erase_if(stops, [&](const Stop& stop) {
        return position_points[stop.point].pin >= 0 || position_points[stop.point].fixed ||
               stop.bare_before + stop.bare_after == 0;
    });
    if (stops.empty()) return {};
    std::vector<int> found;
    for (const Stop& stop : stops) {
        if (stop.bare_before > 0 && stop.bare_after > 0) found.push_back(stop.point);
    }
    if (found.empty()) {
        found.push_back(std::ranges::max_element(stops, {}, [](const Stop& stop) {
                            return stop.bare_before + stop.bare_after;
                        })->point);
    }
    return found;
}

std::size_t longestTrackableRun(const Trajectory& trajectory, const std::vector<double>& corners) {
    std::size_t longest = 0;
    std::size_t run = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        run = isUntrackable(corners[i]) ? 0 : continuesPath(trajectory, i) ? run + 1 : 1;
        longest = std::max(longest, run);
    }
    return longest;
}

}  // namespace dollytrack::planning
