#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "planning/baselines/rival_scene.h"
#include "planning/coverage/surface_patches.h"

#include <vector>

namespace dollytrack::planning {

/// The surface that a camera can see from the places that it can reach, as samples: at most one a
/// cube of `spacing_m` and direction of surface. Normals point to a place that sees the sample.
/// Found by rays from places spread evenly over the free space, so that what is hidden from all of
/// them has no sample. The same scene and parameters give the same samples. Error: Cancelled.
Result<std::vector<SurfacePatch>> reachableSurface(const RivalScene& scene, double spacing_m,
                                                   const JobContext& job);

}  // namespace dollytrack::planning
