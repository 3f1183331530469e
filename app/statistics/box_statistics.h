#pragma once

#include "app/statistics/dataset_statistics.h"

namespace dollytrack::statistics {

/// Reads annotations.json, if the dataset has it, and adds boxes, classes, captures and the heat
/// map to `into`, whose example frames get their boxes. Error: BadInput for damaged annotations.
[[nodiscard]] Status addBoxes(const verify::StoredDataset& dataset, DatasetStatistics& into);

}  // namespace dollytrack::statistics
