#pragma once

#include "planning/path/roadmap_part.h"

#include <vector>

namespace dollytrack::planning {

/// A walk along the branch of the part's tree with the largest weights of position points together
/// (without weights: with most vertices). It leaves the branch for pinned points only, and comes
/// back. With ends given it is the longest branch from there, or the one between them.
std::vector<PathVertex> walkBranch(const RoadmapPart& part, const std::vector<double>& weights,
                                   const WayEnds& ends);

}  // namespace dollytrack::planning
