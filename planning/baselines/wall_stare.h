#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// A control, not a method: a camera that sways by 15 cm before the barest piece of wall
/// that random views show. Whatever measures the worth of frames must find these bad.
Result<Flight> planWallStare(const RivalScene& scene, const PlanParams& params, int seed,
                             const JobContext& job);

}  // namespace dollytrack::planning
