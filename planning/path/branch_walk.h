#pragma once

#include "planning/path/roadmap_part.h"

#include <vector>

namespace dollytrack::planning {

/// A walk along the branch of the part's spanning tree with the largest sum of weights (by position
/// point; empty: the most vertices). It leaves the branch for fixed points only, and returns. Given
/// ends determine one or both ends of the branch. A closed walk returns along the branch.
std::vector<PathVertex> walkBranch(const RoadmapPart& part, const std::vector<double>& weights,
                                   const PartEnds& ends);

}  // namespace dollytrack::planning
