#pragma once

#include "app/statistics/dataset_statistics.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::statistics {

/// A number of whole datasets.
struct OverviewRow {
    const char* key;    // in JSON, with its unit
    const char* label;  // with the unit as shown
    double factor;      // shown / stored number: 100 for shares, which are shown in %
    std::optional<double> (*value)(const DatasetStatistics& dataset);  // nothing if it is unknown
};

/// The numbers that describe a dataset as a whole, in the order in which they are shown.
[[nodiscard]] std::span<const OverviewRow> overview();

/// A class in all datasets, matched by name.
struct ClassRow {
    std::string name;
    std::vector<const ClassStatistics*>
        datasets;  // null: the dataset has neither boxes nor targets

    /// Of all datasets.
    [[nodiscard]] std::size_t sum(std::size_t ClassStatistics::*number) const;
};

/// The classes of all datasets, those with the largest sum of `number` first.
[[nodiscard]] std::vector<ClassRow> classRowsOf(std::span<const DatasetStatistics> datasets,
                                                std::size_t ClassStatistics::*number);

}  // namespace dollytrack::statistics
