#pragma once

#include "planning/free_space/leak_report.h"

#include <string>
#include <vector>

namespace dollytrack::planning {

/// A sentence for each kind of opening on each side of each room: of several openings it tells
/// their number, their area in all and the largest. In the order of the report.
[[nodiscard]] std::vector<std::string> describeAll(const LeakReport& report);

}  // namespace dollytrack::planning
