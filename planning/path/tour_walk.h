#pragma once

#include "engine/jobs/job.h"
#include "planning/path/roadmap_part.h"

#include <functional>
#include <vector>

namespace dollytrack::planning {

class SweptSphere;
struct RoadmapParams;

/// How far the tours may go together, and what each object is worth when some must be left out.
struct TourBudget {
    double max_length_m = 0.0;           // 0: any length
    int max_stops = 0;                   // with a length; 0: any number
    std::vector<double> object_weights;  // of index id - 1; empty: all alike
    std::vector<int> rank;  // of position points as key frames, the most useful first; or empty
    std::function<double(const CameraPath&)> flown_m;  // see PathEnds
    double corner_distance_m = 0.0;
};

/// A walk through every key frame of each part: in the order of shortTour() over the shortest ways
/// in the roadmap, each leg without the corners it can skip. Together they keep to the budget: the
/// first of tourChoices() whose walk does, so that a larger budget never shows less; the walk of a
/// part may be empty then.
std::vector<std::vector<PathVertex>> walkTours(const std::vector<RoadmapPart>& parts,
                                               const std::vector<WayEnds>& ends,
                                               const SweptSphere& sphere, const TourBudget& budget,
                                               const RoadmapParams& weights, const JobContext& job);

}  // namespace dollytrack::planning
