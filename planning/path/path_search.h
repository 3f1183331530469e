#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

#include <functional>
#include <vector>

namespace dollytrack::planning {

class SweptSphere;
struct PathParams;
struct RoadmapParams;

/// Where the trajectory begins and ends.
struct PathEnds {
    int start = -1;                    // position point that the first path begins with; -1: any
    int end = -1;                      // position point that the last path ends with; -1: any
    bool loop = false;                 // each path ends where it begins
    std::vector<double> weights = {};  // of the position points; empty: all alike
    std::vector<double> object_weights = {};  // of index id - 1; empty: all alike
    int visits = 0;  // key frames that all paths may visit, returns counted; 0: no limit
    /// Whether it is the tour that chooses among the key frames, by metres as well.
    bool chosen_by_tour = false;
    std::vector<int> rank = {};  // of position points among the key frames; may be empty
    /// Metres of a path as it will be smoothed, never more than its own; where there is none, a
    /// limit of length holds for paths as they are.
    std::function<double(const CameraPath&)> flown_m = {};
    double corner_distance_m = 0.0;  // the largest set-back of smoothing
};

/// Takes a way through each connected part of the roadmap, largest part first (paper, 3.2.3).
/// A depth-first search first marks the edges that close cycles (`in_tree` = false).
/// `longest_branch` follows the tree's branch with most vertices (of the largest weights together),
/// and makes detours to pinned points only. `tour` visits every key frame: the order comes from the
/// shortest ways in the roadmap, weighed as Near weighs them; each leg then skips the corners it
/// can; with `max_length_m` see walkTours(). The part with the start comes first, that with
/// the end last; one with both comes first. Loops are closed as long as the limit of visits allows.
/// Error: Cancelled.
Result<std::vector<CameraPath>> takePaths(Roadmap& roadmap,
                                          const std::vector<PositionPoint>& position_points,
                                          const SweptSphere& sphere, const PathParams& params,
                                          const RoadmapParams& weights, const PathEnds& ends,
                                          const JobContext& job);

}  // namespace dollytrack::planning
