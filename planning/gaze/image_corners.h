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
/// CornerPanorama. Error: Cancelled.
Result<std::vector<double>> estimateImageCorners(const ViewEstimator& views,
                                                 const TextureCorners& textures,
                                                 const Trajectory& trajectory,
                                                 const JobContext& job);

/// Lowers the weights of objects (index id - 1) whose views all show few corners, so that a budget
/// drops these views first. `object_weights` may be empty, which means 1 for each.
void weighByCorners(const ViewEstimator& views, const TextureCorners& textures,
                    const std::vector<PositionPoint>& position_points,
                    std::vector<double>& object_weights);

/// Share of the frames with at least kTrackableCorners, 0..1; empty without frames.
[[nodiscard]] std::optional<double> trackableRate(const std::vector<double>& corners);

}  // namespace dollytrack::planning
