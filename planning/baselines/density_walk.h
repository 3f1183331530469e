#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// A walk drawn to where triangles are dense: Hypersim (Roberts et al., ICCV 2021, section 3).
/// Taken: each view is chosen among 20 random candidates near the last (out of 1,000 drawn within
/// 1.5 m sideways and 0.25 m in height) whose camera and looked-at point are each seen from the
/// last ones; drawn with a chance proportional to valid fraction squared times the number of
/// different triangles hit; sequences of 100 views. Different: the first view, which an artist
/// chose, is the best of 20 random ones; 64 x 48 rays judge a candidate instead of 256 x 192; and
/// only places where the camera's sphere fits in our map are drawn.
Result<Flight> planDensityWalk(const RivalScene& scene, const PlanParams& params, int seed,
                               const JobContext& job);

}  // namespace dollytrack::planning
