#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

namespace dollytrack::planning {

class SweptSphere;
class ViewEstimator;
class ViewCache;

struct CaptureEstimate {
    std::vector<ObjectCapture> captures;
    std::vector<std::vector<ObjectView>> frame_views;           // see Plan
    std::vector<std::vector<Eigen::AlignedBox2d>> frame_boxes;  // see imageBoxes()
};

/// Estimates by rays how each target appears along a trajectory: a coarse pass over all frames that
/// may show it, then exact estimates of the best few. `memo`, unless null, caches estimates by
/// pose. Error: Cancelled.
Result<CaptureEstimate> estimateCaptures(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job, ViewCache* memo = nullptr);

/// Measures the motion: length, clearance, collisions, repeats. Error: Cancelled.
Result<TrajectoryMetrics> measureTrajectory(const ViewEstimator& views,
                                            const std::vector<SmoothPath>& paths,
                                            const Trajectory& trajectory, const SweptSphere& sphere,
                                            const RayCaster& rays, const JobContext& job);

}  // namespace dollytrack::planning
