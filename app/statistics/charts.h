#pragma once

#include "app/statistics/dataset_statistics.h"
#include "app/statistics/histogram.h"
#include "app/statistics/overview.h"

#include <span>
#include <string>

namespace dollytrack::statistics {

// Charts as SVG, ready for the page. Dataset i is drawn in the colour of the style's class "s" + i.

/// Histograms of a quantity as shares of each dataset's values, with the medians.
[[nodiscard]] std::string histogramChart(const QuantityInfo& info, const Bins& bins,
                                         std::span<const DatasetStatistics> datasets);

/// The number of rows in a chart; fewer of many datasets.
[[nodiscard]] std::size_t chartClassesOf(std::span<const ClassRow> rows);

/// Numbers of boxes by class.
[[nodiscard]] std::string boxesByClassChart(std::span<const ClassRow> rows);

/// Numbers of captured objects (filled) and target objects (outlined) by class.
[[nodiscard]] std::string capturedByClassChart(std::span<const ClassRow> rows);

/// Where box centres lie in the image of a dataset. Cells with at least this share of the boxes are
/// drawn in the full colour.
[[nodiscard]] std::string heatMapChart(const DatasetStatistics& statistics, std::size_t dataset,
                                       double full_share);

/// The share of the boxes that only 2 % of the cells with boxes exceed; 0 without boxes. A single
/// cell with very many boxes must not make all others pale.
[[nodiscard]] double fullShareOf(const HeatMap& map);

}  // namespace dollytrack::statistics
