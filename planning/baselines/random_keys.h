#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Random key frames joined by RRT*: TartanAir (Wang et al., IROS 2020, section 3). Its generator
/// is not public, so this follows its description: key places drawn from free space, joined by
/// RRT*, flown at even speed; roll-free headings that turn from key to key. Different: speed is
/// twice `max_speed_mps` (a drone's), and all keys of a room are one flight.
Result<Flight> planRandomKeysEasy(const RivalScene& scene, const PlanParams& params, int seed,
                                  const JobContext& job);

/// The same with TartanAir's bumps: sinusoids on position and orientation. What is published does
/// not say whether shaken frames are checked; here a frame is left unshaken where the camera would
/// not fit, and the ways between shaken frames are not checked.
Result<Flight> planRandomKeysHard(const RivalScene& scene, const PlanParams& params, int seed,
                                  const JobContext& job);

}  // namespace dollytrack::planning
