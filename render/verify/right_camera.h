#pragma once

#include "render/verify/read/stored_dataset.h"

#include <optional>

namespace dollytrack::verify {

/// How far the right camera of the stereo pair is from the left one, m; nothing when no stereo
/// modality of the dataset tells.
std::optional<double> baselineOf(const StoredDataset& dataset);

/// The same camera, moved by so much along its x axis.
Pose rightOf(const Pose& left, double baseline_m);

}  // namespace dollytrack::verify
