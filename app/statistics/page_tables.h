#pragma once

#include "app/statistics/dataset_statistics.h"
#include "app/statistics/overview.h"

#include <span>
#include <string>

namespace dollytrack::statistics {

// Tables as HTML, with a column per dataset. Columns after the first also show the difference from
// the first dataset.

[[nodiscard]] std::string overviewTable(std::span<const DatasetStatistics> datasets);

/// At most 100 classes.
[[nodiscard]] std::string classTable(std::span<const ClassRow> rows,
                                     std::span<const DatasetStatistics> datasets);

}  // namespace dollytrack::statistics
