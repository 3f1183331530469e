#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack {
struct Plan;
}

namespace dollytrack::planning {

/// Converts a plan: between frames the camera follows the smoothed paths.
PlannedMotion plannedMotionOf(const Plan& plan);

/// Dollytrack's own planner, the whole Pipeline. `plan_ms` excludes the map, which all planners
/// share, and the metrics. Errors as Pipeline::run().
Result<PlannedMotion> planWithDollytrack(const MappedScene& scene, const PlanParams& params,
                                         int seed, const JobContext& job);

/// Dollytrack's path with the smoothing of "Camera Pose Generation Based on Unity3D" (Information
/// 2025, 16(4), 315): one set-back for all corners, without regard to obstacles. Without room and
/// context views.
Result<PlannedMotion> planPaperSmoothing(const MappedScene& scene, const PlanParams& params,
                                         int seed, const JobContext& job);

/// Smooths the path of an existing plan as planPaperSmoothing() does, and gives it frame times. The
/// plan must have been made with these parameters. Errors as timeTrajectory().
Result<PlannedMotion> smoothAsThePaper(const MappedScene& scene, const Plan& plan,
                                       const PlanParams& params);

}  // namespace dollytrack::planning
