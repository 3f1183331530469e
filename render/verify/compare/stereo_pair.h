#pragma once

#include "render/verify/read/stored_dataset.h"

#include <optional>

namespace dollytrack::verify {

/// Baseline of the stereo pair, m; nothing if no stereo modality of the dataset specifies it.
std::optional<double> baselineOf(const StoredDataset& dataset);

/// The left camera moved by the baseline along its x axis.
Pose rightOf(const Pose& left, double baseline_m);

}  // namespace dollytrack::verify
