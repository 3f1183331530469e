#pragma once

#include "engine/document/edits.h"
#include "engine/plan/viewpoint.h"
#include "engine/scene/scene.h"

#include <vector>

namespace dollytrack::planning {

/// The weight of each object, at index id - 1: the largest weight of the regions that contain the
/// centre of its box, or 1 outside all regions. Empty if every weight is 1.
std::vector<double> objectWeights(const Scene& scene, const std::vector<Region>& regions);

/// The weight of each position point: the largest weight of the objects it captures, or 1 if it
/// captures none. Empty if `object_weights` is.
std::vector<double> pointWeights(const std::vector<PositionPoint>& points,
                                 const std::vector<double>& object_weights);

}  // namespace dollytrack::planning
