#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"

namespace dollytrack::planning {

class ViewEstimator;

/// What the images of a trajectory show as a whole; see TrajectoryMetrics for the two rates.
struct ShownSurface {
    double repeat_rate = 0.0;
    double object_pixels = 0.0;
};

/// By a grid of rays through every frame. Error: Cancelled.
Result<ShownSurface> measureShownSurface(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job);

}  // namespace dollytrack::planning
