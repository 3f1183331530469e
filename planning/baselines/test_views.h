#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Test views for models that were trained on a planner's frames: independent poses at random
/// positions 1 to 3 m from a random visible object, directed at its centre. Errors: Cancelled;
/// Failed if there is no object, or none is visible at these distances.
Result<PlannedMotion> planObjectFacing(const MappedScene& scene, const PlanParams& params, int seed,
                                       const JobContext& job);

/// Like planObjectFacing(), at 0.3 to 1 m.
Result<PlannedMotion> planCloseViews(const MappedScene& scene, const PlanParams& params, int seed,
                                     const JobContext& job);

}  // namespace dollytrack::planning
