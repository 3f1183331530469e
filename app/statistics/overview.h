#pragma once

#include "app/statistics/dataset_statistics.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::statistics {

/// A number of every dataset.
struct OverviewRow {
    const char* key;    // in JSON, with its unit
    const char* label;  // with the unit as shown
    double factor;      // shown / stored number: 100 for shares, which are shown in %
    std::vector<std::optional<double>> values;  // by dataset; nothing if it is unknown
};

/// The numbers that describe a dataset as a whole, in the order in which they are shown.
[[nodiscard]] std::vector<OverviewRow> overviewOf(std::span<const DatasetStatistics> datasets);

/// A class in all datasets, matched by name.
struct ClassRow {
    std::string name;
    std::vector<const ClassStatistics*>
        datasets;  // null: the dataset has neither boxes nor targets
};

/// The classes of all datasets, those with the most boxes first.
[[nodiscard]] std::vector<ClassRow> classRowsOf(std::span<const DatasetStatistics> datasets);

}  // namespace dollytrack::statistics
