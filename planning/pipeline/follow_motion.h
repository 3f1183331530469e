#pragma once

#include "engine/core/result.h"
#include "engine/document/given_motion.h"
#include "engine/jobs/job.h"
#include "planning/plan_params.h"
#include "planning/repair/repair.h"

namespace dollytrack::planning {

class FreeSpace;
class SweptSphere;

/// The parameters without those that only affect planned trajectories: budgets, rooms=each,
/// anchors, views of rooms, and repair.
[[nodiscard]] PlanParams paramsForMotion(PlanParams params);

/// A given motion as the trajectory of a plan. The paths are straight lines from frame to frame;
/// those that collide are counted, not changed. Error: Cancelled.
[[nodiscard]] Result<RepairedTrajectory> followMotion(const GivenMotion& motion,
                                                      const FreeSpace& free_space,
                                                      const SweptSphere& sphere,
                                                      const JobContext& job);

}  // namespace dollytrack::planning
