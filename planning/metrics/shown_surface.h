#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <vector>

namespace dollytrack::planning {

class ViewEstimator;

/// What the images of a trajectory show as a whole; see TrajectoryMetrics for the two rates.
struct ShownSurface {
    double repeat_rate = 0.0;
    double object_pixels = 0.0;
};

/// The patches of surface that each frame shows, numbered from 0: what tells repeats apart, for
/// any choice of the frames.
class FrameSurfaces {
  public:
    /// By a grid of rays through every frame. Error: Cancelled.
    static Result<FrameSurfaces> look(const ViewEstimator& views, const Trajectory& trajectory,
                                      const JobContext& job);

    /// How many of the frames, taken in this order, show nothing new; see TrajectoryMetrics.
    [[nodiscard]] int repeats(const std::vector<std::size_t>& frames) const;

    /// Mean share of the rays that meet targets.
    [[nodiscard]] double objectPixels() const { return object_pixels_; }
    [[nodiscard]] std::size_t frames() const { return shown_.size(); }

  private:
    std::vector<std::vector<int>> shown_;  // by frame, each patch once
    int patches_ = 0;
    double object_pixels_ = 0.0;
};

/// By a grid of rays through every frame. Error: Cancelled.
Result<ShownSurface> measureShownSurface(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job);

}  // namespace dollytrack::planning
