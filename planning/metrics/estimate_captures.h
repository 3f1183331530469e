#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

namespace dollytrack::planning {

class SweptSphere;
class ViewEstimator;

/// How every target shows along a trajectory, estimated by rays: a coarse look at all frames that
/// may show it, then a look at every pixel for the best few. Error: Cancelled.
Result<std::vector<ObjectCapture>> estimateCaptures(const ViewEstimator& views,
                                                    const Trajectory& trajectory,
                                                    const JobContext& job);

/// The metrics about the motion itself. Error: Cancelled.
Result<TrajectoryMetrics> measureTrajectory(const ViewEstimator& views,
                                            const std::vector<SmoothPath>& paths,
                                            const Trajectory& trajectory, const SweptSphere& sphere,
                                            const JobContext& job);

}  // namespace dollytrack::planning
