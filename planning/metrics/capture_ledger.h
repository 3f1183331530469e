#pragma once

#include "engine/plan/plan.h"

#include <string>
#include <vector>

namespace dollytrack::planning {

/// One row per target of a measured plan: how it is captured or, if not captured well, the stage at
/// which that was lost and why. Uses the plan only, without new estimates; findRemedies() searches
/// for what would help. `left_out_for` is the reason given for key frames that are not on a path,
/// for example "to keep to max_length_m".
std::vector<LedgerRow> captureLedger(
    const Scene& scene, const Plan& plan,
    const std::string& left_out_for = "because no collision-free path to it was found");

}  // namespace dollytrack::planning
