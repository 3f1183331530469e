#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "planning/baselines/baseline_scene.h"
#include "planning/coverage/surface_patches.h"

#include <vector>

namespace dollytrack::planning {

/// Samples of the surface visible from about 400 to 800 positions spread over the free space, at
/// most one per grid cell of edge `spacing_m` and orientation. Normals face the position that saw
/// the sample. Deterministic. Error: Cancelled.
Result<std::vector<SurfacePatch>> reachableSurface(const MappedScene& scene, double spacing_m,
                                                   const JobContext& job);

}  // namespace dollytrack::planning
