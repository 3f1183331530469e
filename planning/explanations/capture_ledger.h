#pragma once

#include "engine/plan/plan.h"

#include <string>
#include <vector>

namespace dollytrack::planning {

/// Reasons for views that were found but left out, as phrases.
struct ExclusionReasons {
    std::string path = "because no collision-free path to it was found";  // not on a path
    std::string key_frames = "to keep within max_frames";                 // no key frame
    bool given_motion = false;  // the trajectory was given, so no view was chosen for it
};

/// One row per target of a measured plan: how it is captured or, if not captured well, the stage at
/// which that was lost and why. Uses the plan only, without new estimates; findRemedies() searches
/// for what would help.
std::vector<LedgerRow> captureLedger(const Scene& scene, const Plan& plan,
                                     const ExclusionReasons& reasons = {});

}  // namespace dollytrack::planning
