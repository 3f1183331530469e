#pragma once

#include "engine/jobs/job.h"
#include "planning/path/roadmap_part.h"

#include <functional>
#include <set>
#include <vector>

namespace dollytrack::planning {

class SweptSphere;
struct RoadmapParams;

/// Budget of all tours together, and the worth of objects if stops must be dropped.
struct TourBudget {
    double max_length_m = 0.0;           // 0: no limit
    int max_stops = 0;                   // used only with a length; 0: no limit
    std::vector<double> object_weights;  // by object, at index id - 1; empty: all 1
    std::vector<int> rank;  // by position point: rank among key frames, 0 is the most useful; may
                            // be empty
    std::set<int> avoided;  // see PathEnds
    std::function<double(const CameraPath&)> smooth_length_m;  // see PathEnds
    double corner_distance_m = 0.0;
};

/// A walk through the key frames of each part, in the order of shortTour() over shortest paths in
/// the roadmap; each leg skips unnecessary corners. Under a budget, the first of tourChoices()
/// whose walks fit it, so that a larger budget never shows less; the walk of a part may then be
/// empty.
std::vector<std::vector<PathVertex>> walkTours(const std::vector<RoadmapPart>& parts,
                                               const std::vector<PartEnds>& ends,
                                               const SweptSphere& sphere, const TourBudget& budget,
                                               const RoadmapParams& weights, const JobContext& job);

}  // namespace dollytrack::planning
