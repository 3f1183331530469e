#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Baseline: a random walk attracted by dense triangles, as in Hypersim (Roberts et al., ICCV 2021,
/// section 3). As published: each view is chosen among 20 random candidates near the last one (out
/// of 1,000 draws within 1.5 m horizontally and 0.25 m vertically) whose camera and look-at point
/// are visible from the last ones; the probability is proportional to the squared valid fraction
/// times the number of different triangles hit; sequences of 100 views. Differences: the first
/// view, chosen by an artist there, is the best of 20 random ones; 64 x 48 rays instead of 256 x
/// 192; only positions where the camera sphere fits in the map are drawn. Error: Cancelled.
Result<PlannedMotion> planDensityWalk(const MappedScene& scene, const PlanParams& params, int seed,
                                      const JobContext& job);

}  // namespace dollytrack::planning
