#pragma once

#include "render/verify/read/stored_dataset.h"

#include <vector>

namespace dollytrack::verify {

/// Points of the surfaces that a dataset's depth images show, world, about one in a cube of
/// `spacing_m`: what a reconstruction from its frames could hold. Of things that move, none. Empty
/// without depth images.
std::vector<Eigen::Vector3d> seenSurface(const StoredDataset& dataset, double spacing_m);

}  // namespace dollytrack::verify
