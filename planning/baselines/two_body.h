#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Two randomly pushed bodies, of which one is the camera and the other what it looks at: SceneNet
/// RGB-D (McCormac et al., ICCV 2017, section 4.3), taken up by InteriorNet (Li et al., BMVC 2018).
/// Taken: bodies of 1 kg pushed at random at 25 steps a second, speed of 3 m/s at most, drag,
/// bouncing off what they meet; 500 steps before the first frame; an image every 25th step; a run
/// counts only when the camera moved more than 1 m and saw at least 10 objects. Different: the
/// bodies bounce where the camera's sphere would not fit (theirs by the depth in the picture), a
/// run that does not count is tried again a fixed number of times instead of ending the program,
/// houses get a run for each room, and the strengths of pushes and drag, which no publication
/// gives, are ours. InteriorNet's learned styles of motion are not public.
Result<Flight> planTwoBody(const RivalScene& scene, const PlanParams& params, int seed,
                           const JobContext& job);

}  // namespace dollytrack::planning
