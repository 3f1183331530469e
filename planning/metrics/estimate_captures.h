#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

namespace dollytrack::planning {

class SweptSphere;
class ViewEstimator;
class ViewMemo;

struct CaptureEstimate {
    std::vector<ObjectCapture> captures;
    std::vector<std::vector<ObjectView>> frame_views;           // see Plan
    std::vector<std::vector<Eigen::AlignedBox2d>> frame_boxes;  // see imageBoxes()
};

/// How every target shows along a trajectory, estimated by rays: a coarse look at all frames that
/// may show it, then a look at every pixel for the best few. `memo`, unless null,
/// spares looks from poses it knows, and learns the others. Error: Cancelled.
Result<CaptureEstimate> estimateCaptures(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job, ViewMemo* memo = nullptr);

/// The metrics about the motion itself. Error: Cancelled.
Result<TrajectoryMetrics> measureTrajectory(const ViewEstimator& views,
                                            const std::vector<SmoothPath>& paths,
                                            const Trajectory& trajectory, const SweptSphere& sphere,
                                            const RayCaster& rays, const JobContext& job);

}  // namespace dollytrack::planning
