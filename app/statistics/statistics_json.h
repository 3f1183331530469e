#pragma once

#include "app/statistics/dataset_statistics.h"

#include <nlohmann/json.hpp>

#include <span>

namespace dollytrack::statistics {

/// All numbers of the page. Shares are 0 to 1. Contains neither a clock nor a path.
[[nodiscard]] nlohmann::json statisticsJson(std::span<const DatasetStatistics> datasets);

}  // namespace dollytrack::statistics
