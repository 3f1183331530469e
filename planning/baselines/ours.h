#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack {
struct Plan;
}

namespace dollytrack::planning {

/// A plan as a flight: between frames the camera follows the smoothed paths.
Flight flightOf(const Plan& plan);

/// Dollytrack's own method, the whole Pipeline. `plan_ms` is that of its stages, without the map,
/// which all planners share, and without its metrics.
Result<Flight> planOurs(const RivalScene& scene, const PlanParams& params, int seed,
                        const JobContext& job);

/// The same as far as the path, then the smoothing as "Camera Pose Generation Based on Unity3D"
/// (Information 2025, 16(4), 315) has it: one set-back for all corners and no look at obstacles.
Result<Flight> planPaperSmoothing(const RivalScene& scene, const PlanParams& params, int seed,
                                  const JobContext& job);

/// The latter from a plan that was made with these parameters. Error: that of timeTrajectory().
Result<Flight> smoothAsThePaper(const RivalScene& scene, const Plan& plan,
                                const PlanParams& params);

}  // namespace dollytrack::planning
