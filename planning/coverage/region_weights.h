#pragma once

#include "engine/document/edits.h"
#include "engine/plan/viewpoint.h"
#include "engine/scene/scene.h"

#include <vector>

namespace dollytrack::planning {

/// The weight of each object, of index id - 1: the largest of the regions that hold its box's
/// centre, 1 outside all. Nothing where every object weighs 1.
std::vector<double> objectWeights(const Scene& scene, const std::vector<Region>& regions);

/// The weight of each position point: that of the weightiest object it captures; 1 for a fixed one
/// that captures nothing. Nothing where every object weighs 1.
std::vector<double> pointWeights(const std::vector<PositionPoint>& points,
                                 const std::vector<double>& object_weights);

}  // namespace dollytrack::planning
