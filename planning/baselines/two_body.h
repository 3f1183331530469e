#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Baseline: two randomly pushed bodies, the camera and its look-at point, as in SceneNet RGB-D
/// (McCormac et al., ICCV 2017, section 4.3) and InteriorNet (Li et al., BMVC 2018). As published:
/// bodies of 1 kg pushed at random, 25 steps per second, at most 3 m/s, drag, bouncing off
/// obstacles; 500 steps before the first frame; an image every 25th step; a run counts only if the
/// camera moved more than 1 m and saw at least 10 objects. Differences: bodies bounce where the
/// camera sphere would not fit (there: by image depth); a run that does not count is repeated up to
/// 8 times, and the last is used; houses get one run per room; the unpublished strengths of pushes
/// and drag are our own. InteriorNet's learned motion styles are not public. Error: Cancelled.
Result<PlannedMotion> planTwoBody(const MappedScene& scene, const PlanParams& params, int seed,
                                  const JobContext& job);

}  // namespace dollytrack::planning
