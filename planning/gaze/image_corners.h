#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/viewpoint.h"

#include <vector>

namespace dollytrack::planning {

class TextureCorners;
class ViewEstimator;

/// Estimated number of corners in each frame's image, scaled to a width of 320 pixels; see
/// CornerPanorama. At most 1.5 times the corners that the image five frames earlier (or the first
/// frame of its path, if that is later) shows too: SLAM programs track a frame by corners that they
/// know already. Error: Cancelled.
Result<std::vector<double>> estimateImageCorners(const ViewEstimator& views,
                                                 const TextureCorners& textures,
                                                 const Trajectory& trajectory,
                                                 const JobContext& job);

/// Lowers the weight of each object that no position point captures in a view of many corners. A
/// plan with limited frames leaves out such objects first. The weights are incomplete if the job
/// is cancelled.
/// @param object_weights  by object, at index id - 1; empty: all 1
void weighByCorners(const ViewEstimator& views, const TextureCorners& textures,
                    const std::vector<PositionPoint>& position_points,
                    std::vector<double>& object_weights, const JobContext& job);

/// Indices of the position points whose key frames have frames with fewer than kTrackableCorners
/// both before and after them, up to the neighbouring key frames of the same path. If there are
/// none, the one with the most such frames around it. Never pinned or fixed points. May contain a
/// point twice.
[[nodiscard]] std::vector<int> pointsAmongBareViews(
    const Trajectory& trajectory, const std::vector<double>& corners,
    const std::vector<PositionPoint>& position_points);

/// Largest number of consecutive frames of one path with at least kTrackableCorners.
[[nodiscard]] std::size_t longestTrackableRun(const Trajectory& trajectory,
                                              const std::vector<double>& corners);

}  // namespace dollytrack::planning
