#pragma once

#include "app/statistics/dataset_statistics.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <span>
#include <string>

namespace dollytrack::statistics {

/// The most datasets of a page: there are as many colours that everybody can tell apart.
inline constexpr std::size_t kMostDatasets = 6;

/// The most example frames of a page.
inline constexpr std::size_t kMostExamples = 8;

/// The most frames of a dataset whose images are read. Of datasets that are counted together, each
/// has an equal share of them, but at least one.
inline constexpr std::size_t kMostImages = 200;

/// One HTML page of charts and tables that needs no other file and no scripts. Equal input gives
/// equal bytes.
[[nodiscard]] std::string statisticsPage(std::span<const DatasetStatistics> datasets);

/// All numbers of the page. Shares are 0 to 1. Contains neither a clock nor a path.
[[nodiscard]] nlohmann::json statisticsJson(std::span<const DatasetStatistics> datasets);

}  // namespace dollytrack::statistics
