#pragma once

#include "app/statistics/dataset_statistics.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dollytrack::statistics {

/// Bin i holds edges[i] <= value < edges[i + 1]; the last bin also holds its upper edge.
struct Bins {
    std::vector<double> edges;  // increasing, at least two
    bool logarithmic = false;
};

struct Histogram {
    std::vector<std::uint64_t> counts;  // by bin
    std::uint64_t beyond = 0;           // values outside the bins
    std::uint64_t total = 0;            // all values
};

/// Quantiles with linear interpolation.
struct Spread {
    double p10 = 0.0;
    double median = 0.0;
    double p90 = 0.0;
};

/// The bins of each quantity, the same for all datasets; nothing if no dataset has values.
using SharedBins = std::array<std::optional<Bins>, kQuantities>;

[[nodiscard]] SharedBins sharedBinsOf(std::span<const DatasetStatistics> datasets);

[[nodiscard]] Histogram histogramOf(const Bins& bins, const std::vector<double>& values);

/// Nothing if there are no values.
[[nodiscard]] std::optional<Spread> spreadOf(std::vector<double> values);

}  // namespace dollytrack::statistics
