#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

namespace dollytrack::planning {

struct Surroundings;

/// What no planner can pass: for every target a dense search over legal poses (directions all
/// around it times distances, then free places at random), looking at it, and the places at which
/// remedies are looked for. A search finds no true bound: what it misses may still exist. Takes
/// seconds, so only on request. Poses of `plan` are tried first. Error: Cancelled.
Result<CaptureBound> boundCaptures(const Surroundings& around, const Plan& plan, int seed,
                                   const JobContext& job);

}  // namespace dollytrack::planning
