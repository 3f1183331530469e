#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Views to test on what was trained with a planner's frames: from random places 1 to 3 m away from
/// a random object that is in sight, at its middle. Each frame stands for itself.
Result<Flight> planObjectFacing(const RivalScene& scene, const PlanParams& params, int seed,
                                const JobContext& job);

/// The same from 0.3 to 1 m.
Result<Flight> planCloseViews(const RivalScene& scene, const PlanParams& params, int seed,
                              const JobContext& job);

}  // namespace dollytrack::planning
