#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Control: a camera that sways by 15 cm in front of the barest wall found among 2000 random views.
/// Any measure of the value of frames must rate these low. Error: Cancelled.
Result<PlannedMotion> planWallStare(const MappedScene& scene, const PlanParams& params, int seed,
                                    const JobContext& job);

}  // namespace dollytrack::planning
