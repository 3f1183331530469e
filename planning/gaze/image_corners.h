#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/viewpoint.h"

#include <optional>
#include <vector>

namespace dollytrack::planning {

class TextureCorners;
class ViewEstimator;

/// Estimated number of corners in each frame's image, scaled to a width of 320 pixels; see
/// CornerPanorama. At most 1.5 times the corners that the image five frames earlier shows too:
/// SLAM programs track a frame by corners that they know already. Error: Cancelled.
Result<std::vector<double>> estimateImageCorners(const ViewEstimator& views,
                                                 const TextureCorners& textures,
                                                 const Trajectory& trajectory,
                                                 const JobContext& job);

/// Lowers the weight of each object that no position point captures in a view of many corners. A
/// plan with limited frames leaves out such objects first.
/// @param object_weights  by object, at index id - 1; empty: all 1
void weighByCorners(const ViewEstimator& views, const TextureCorners& textures,
                    const std::vector<PositionPoint>& position_points,
                    std::vector<double>& object_weights, const JobContext& job);

/// Key frames between frames with too few corners: before and after them. If there are none, the
/// key frame next to the most such frames. Never pinned or fixed ones. Indices of position points.
[[nodiscard]] std::vector<int> pointsAmongBareViews(
    const Trajectory& trajectory, const std::vector<double>& corners,
    const std::vector<PositionPoint>& position_points);

/// Largest number of consecutive frames of one path with at least kTrackableCorners.
[[nodiscard]] std::size_t longestTrackableRun(const Trajectory& trajectory,
                                              const std::vector<double>& corners);

/// Share of the frames with at least kTrackableCorners, 0..1; empty without frames.
[[nodiscard]] std::optional<double> trackableRate(const std::vector<double>& corners);

}  // namespace dollytrack::planning
