#pragma once

#include "engine/plan/plan.h"

#include <vector>

namespace dollytrack::planning {

/// One row for each target of a measured plan: how it is captured or, when it is not captured well,
/// at which stage that was lost and why. Read off the plan alone, without looking again, so it
/// costs next to nothing; what would help is searched for by findRemedies().
std::vector<LedgerRow> captureLedger(const Scene& scene, const Plan& plan);

}  // namespace dollytrack::planning
