#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <vector>

namespace dollytrack::planning {

class ViewEstimator;

/// What the images of a trajectory show, by a grid of rays for each image. The surface is divided
/// into patches of 0.1 m; TrajectoryMetrics has the definition of a repeated frame.
struct ShownSurface {
    /// By frame: the number of patches that no frame before it shows, as a share of the rays.
    std::vector<double> new_shares;
    double object_pixels = 0.0;  // mean share of the rays that hit targets, 0..1

    /// Whether a frame shows nothing new: new patches for fewer than 1 % of the rays.
    [[nodiscard]] bool repeats(std::size_t frame) const { return new_shares[frame] < 0.01; }
    /// The share of the frames that show nothing new; 0 without frames.
    [[nodiscard]] double repeatRate() const;
};

/// Casts a grid of rays for each frame. Error: Cancelled.
Result<ShownSurface> measureShownSurface(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job);

}  // namespace dollytrack::planning
