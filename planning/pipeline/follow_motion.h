#pragma once

#include "engine/core/result.h"
#include "engine/document/given_motion.h"
#include "engine/jobs/job.h"
#include "engine/plan/passed_key.h"
#include "planning/plan_params.h"
#include "planning/repair/repair.h"

#include <string>
#include <vector>

namespace dollytrack::planning {

struct MappedScene;

/// The parameters without those that only affect planned trajectories: budgets, rooms=each,
/// anchors, views of rooms, and repair.
[[nodiscard]] PlanParams paramsForMotion(PlanParams params);

/// Names of the parameters that are not at their defaults, but do not apply to a given motion.
[[nodiscard]] std::vector<std::string> withoutEffectOnMotion(const PlanParams& params);

/// A given motion as the trajectory of a plan.
struct FollowedMotion {
    RepairedTrajectory made;
    std::vector<PassedKey> keys;  // how it passes each key of the motion
};

/// Follows the frames of a motion, which are not changed, or moves through its keys (see
/// moveThroughKeys()). The paths are straight lines from frame to frame; those that collide are
/// counted. Errors: Cancelled; those of moveThroughKeys().
[[nodiscard]] Result<FollowedMotion> followMotion(const GivenMotion& motion,
                                                  const MappedScene& scene,
                                                  const TimingParams& timing,
                                                  const JobContext& job);

}  // namespace dollytrack::planning
