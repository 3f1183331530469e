#pragma once

#include "app/statistics/dataset_statistics.h"

#include <cstddef>
#include <span>
#include <string>

namespace dollytrack::statistics {

/// The page stays below this.
inline constexpr std::size_t kMostPageBytes = 2'000'000;

/// The most datasets of a page: there are as many colours that everybody can tell apart.
inline constexpr std::size_t kMostDatasets = 6;

/// The most example frames of a page.
inline constexpr std::size_t kMostExamples = 8;

/// One HTML page of charts and tables that needs no other file and no scripts. Equal input gives
/// equal bytes.
[[nodiscard]] std::string statisticsPage(std::span<const DatasetStatistics> datasets);

}  // namespace dollytrack::statistics
