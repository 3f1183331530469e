#pragma once

#include "engine/jobs/job.h"
#include "planning/path/roadmap_part.h"

#include <vector>

namespace dollytrack::planning {

class SweptSphere;
struct RoadmapParams;

/// How far the tours may go together, and what each object is worth when some must be left out.
struct LengthBudget {
    double max_length_m = 0.0;           // 0: any length
    std::vector<double> object_weights;  // of index id - 1; empty: all alike
};

/// A walk through every key frame of each part: in the order of shortTour() over the shortest ways
/// in the roadmap, each leg without the corners it can skip. Together no longer than the budget
/// allows, as keepWithinLength() chooses; the walk of a part may be empty then.
std::vector<std::vector<PathVertex>> walkTours(const std::vector<RoadmapPart>& parts,
                                               const std::vector<WayEnds>& ends,
                                               const SweptSphere& sphere,
                                               const LengthBudget& budget,
                                               const RoadmapParams& weights, const JobContext& job);

}  // namespace dollytrack::planning
