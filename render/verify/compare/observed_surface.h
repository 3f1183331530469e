#pragma once

#include "render/verify/read/stored_dataset.h"

#include <vector>

namespace dollytrack::verify {

/// World points on the surfaces in a dataset's depth images, about one per cube of `spacing_m`:
/// what a reconstruction from its frames could contain. Moving objects are left out. Empty without
/// depth images.
std::vector<Eigen::Vector3d> observedSurface(const StoredDataset& dataset, double spacing_m);

}  // namespace dollytrack::verify
