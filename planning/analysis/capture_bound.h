#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

namespace dollytrack::planning {

struct PlanningEnvironment;

/// Estimates the highest possible capture rates: for every target that `plan` does not capture
/// well, a dense search over legal poses (many directions and distances, random free positions, and
/// the positions at which remedies are searched). It is not a proven bound, since the search may
/// miss views. Takes seconds. Error: Cancelled.
Result<CaptureBound> boundCaptures(const PlanningEnvironment& environment, const Plan& plan,
                                   int seed, const JobContext& job);

}  // namespace dollytrack::planning
