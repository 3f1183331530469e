#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

#include <functional>
#include <set>
#include <vector>

namespace dollytrack::planning {

class SweptSphere;
struct PathParams;
struct RoadmapParams;

/// Ends, budgets and weights of the paths.
struct PathEnds {
    int start = -1;                    // position point at which the first path starts; -1: any
    int end = -1;                      // position point at which the last path ends; -1: any
    bool loop = false;                 // each path ends where it starts
    std::vector<double> weights = {};  // by position point; empty: all 1
    std::vector<double> object_weights = {};  // by object, at index id - 1; empty: all 1
    int visits = 0;  // most key frames that all paths together may visit, returns included; 0: no
                     // limit
    /// Position points that count as showing nothing, so that a tour that must be shortened drops
    /// them first. They stay if the whole tour fits.
    std::set<int> avoided = {};
    /// Whether the tour chooses among the key frames, by length and number; see isChosenByTour().
    bool chosen_by_tour = false;
    std::vector<int> rank = {};  // by position point: rank among the key frames; may be empty
    /// Length of a path after smoothing, m; must not exceed the path's own length. If empty,
    /// max_length_m limits paths before smoothing.
    std::function<double(const CameraPath&)> smooth_length_m = {};
    double corner_distance_m = 0.0;  // largest set-back of smoothing, m
};

/// Finds a path through each connected part of the roadmap, largest part first (paper, 3.2.3).
/// Marks the edges outside a depth-first spanning tree with `in_tree` = false. `longest_branch`
/// follows the tree's branch with the largest sum of weights, with detours to fixed points only.
/// `tour` visits every key frame in an order that minimises length and turning over shortest paths
/// in the roadmap; each leg then skips unnecessary corners. With `max_length_m` see walkTours().
/// Parts that contain `ends.start` come first, those with `ends.end` last. Loops are closed if
/// `ends.visits` allows. Error: Cancelled.
Result<std::vector<CameraPath>> takePaths(Roadmap& roadmap,
                                          const std::vector<PositionPoint>& position_points,
                                          const SweptSphere& sphere, const PathParams& params,
                                          const RoadmapParams& weights, const PathEnds& ends,
                                          const JobContext& job);

}  // namespace dollytrack::planning
