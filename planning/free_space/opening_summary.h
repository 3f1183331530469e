#pragma once

#include "planning/free_space/opening_report.h"

#include <string>
#include <vector>

namespace dollytrack::planning {

/// One sentence per room, kind of opening and side. For several openings it gives their number,
/// total area and the largest one. Sentences are in the order of the report.
[[nodiscard]] std::vector<std::string> describeAll(const OpeningReport& report);

}  // namespace dollytrack::planning
