#pragma once

#include "engine/plan/plan.h"

#include <string>
#include <vector>

namespace dollytrack::planning {

/// One row for each target of a measured plan: how it is captured or, when it is not captured well,
/// at which stage that was lost and why. Read off the plan alone, without looking again, so it
/// costs next to nothing; what would help is searched for by findRemedies(). `left_out_for`: what
/// the path leaves key frames out for, "to keep to max_length_m".
std::vector<LedgerRow> captureLedger(const Scene& scene, const Plan& plan,
                                     const std::string& left_out_for = "as no way leads there");

}  // namespace dollytrack::planning
