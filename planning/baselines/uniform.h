#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Baseline: random legal poses, as from samplers like BlenderProc's (Denninger et al., JOSS 2023).
/// As published: positions drawn uniformly from free space, headings all around, no motion between
/// frames. Differences: its tests for near obstacles and visible objects are left out, so that this
/// is the plain lower reference; pitch is within 30 degrees. Error: Cancelled.
Result<PlannedMotion> planUniform(const MappedScene& scene, const PlanParams& params, int seed,
                                  const JobContext& job);

}  // namespace dollytrack::planning
