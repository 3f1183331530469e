#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

namespace dollytrack::planning {

struct SmoothingParams;
struct PlanningEnvironment;

/// Rounds the corners of a path with quadratic Bezier curves (paper, 3.2.3) that start and end
/// `corner_distance_m` from each corner, at most half a leg. The distance (set-back) shrinks until
/// the swept camera is free and the key frame at the corner still captures its objects. At
/// reversals, fixed points and corners where no set-back is possible, the camera stops and turns.
/// Error: Cancelled.
Result<SmoothPath> smoothPath(const CameraPath& path,
                              const std::vector<PositionPoint>& position_points,
                              const std::vector<ObservationPoint>& observation_points,
                              const PlanningEnvironment& environment, const SmoothingParams& params,
                              const JobContext& job);

/// The paper's smoothing, for comparison: the same set-back at every corner, at most half a leg,
/// without any tests. Collisions are counted in the result.
SmoothPath smoothBlindly(const CameraPath& path, double corner_distance_m,
                         const PlanningEnvironment& environment);

}  // namespace dollytrack::planning
