#pragma once

#include "app/statistics/dataset_statistics.h"

namespace dollytrack::statistics {

/// At most so many frames' images are read.
inline constexpr std::size_t kMostImages = 200;

/// Measures brightness, colourfulness and depth in evenly spaced frames, and adds them to `into`.
/// Depth is taken at the points of a grid. Error: Cancelled.
[[nodiscard]] Status measureImages(const verify::StoredDataset& dataset, DatasetStatistics& into,
                                   const JobContext& job);

/// Adds the small JPEG images of the example frames, without those that do not exist.
void addExampleImages(const verify::StoredDataset& dataset, DatasetStatistics& into);

}  // namespace dollytrack::statistics
