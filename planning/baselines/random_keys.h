#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Baseline: random key frames joined by RRT*, as in TartanAir (Wang et al., IROS 2020, section 3).
/// Its generator is not public; this follows the description: key positions drawn from free space,
/// joined by RRT*, constant speed, roll-free headings that turn from key to key. Differences: the
/// speed is twice the speed limit (a drone's), and all keys of a room form one trajectory. Error:
/// Cancelled.
Result<PlannedMotion> planRandomKeysEasy(const MappedScene& scene, const PlanParams& params,
                                         int seed, const JobContext& job);

/// The same with TartanAir's shake: sinusoids on position and orientation. The publication does not
/// say whether shaken frames are tested; here a frame stays unshaken where the camera would not
/// fit, and moves between shaken frames are not tested. Error: Cancelled.
Result<PlannedMotion> planRandomKeysHard(const MappedScene& scene, const PlanParams& params,
                                         int seed, const JobContext& job);

}  // namespace dollytrack::planning
