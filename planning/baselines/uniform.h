#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Random legal poses, the baseline of samplers without a plan, as in BlenderProc (Denninger et
/// al., JOSS 2023). Taken: places drawn evenly from free space, headings all around, no motion
/// between frames. Different: its checks for near obstacles and for what is in view are left out,
/// so that this is the plain floor below every method; pitch is kept within 30 degrees.
Result<Flight> planUniform(const RivalScene& scene, const PlanParams& params, int seed,
                           const JobContext& job);

}  // namespace dollytrack::planning
