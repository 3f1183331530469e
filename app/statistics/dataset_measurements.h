#pragma once

#include "app/statistics/dataset_statistics.h"

namespace dollytrack::statistics {

/// Reads annotations.json, if the dataset has it, and adds boxes, classes, captures and the heat
/// map to `statistics`, whose example frames get their boxes. Error: BadInput for damaged
/// annotations.
[[nodiscard]] Status addBoxes(const verify::StoredDataset& dataset, DatasetStatistics& statistics);

/// Measures brightness and depth in `count` evenly spaced frames, and adds them to `statistics`.
/// Depth is taken at the points of a grid. Error: Cancelled.
[[nodiscard]] Status measureImages(const verify::StoredDataset& dataset, std::size_t count,
                                   DatasetStatistics& statistics, const JobContext& job);

/// Adds the small JPEG images of the example frames, without those that do not exist.
void addExampleImages(const verify::StoredDataset& dataset, DatasetStatistics& statistics);

}  // namespace dollytrack::statistics
