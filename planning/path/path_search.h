#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

#include <vector>

namespace dollytrack::planning {

class SweptSphere;
struct PathParams;
struct RoadmapParams;

/// Takes a way through each connected part of the roadmap, largest part first (paper, 3.2.3).
/// A depth-first search first marks the edges that close cycles (`in_tree` = false).
/// `longest_branch` follows the tree's branch with most vertices, and makes detours to pinned
/// points only. `tour` visits every key frame:
/// the order comes from the shortest ways in the roadmap, weighed as Near weighs them; each leg
/// then skips the corners it can. Error: Cancelled.
Result<std::vector<CameraPath>> takePaths(Roadmap& roadmap,
                                          const std::vector<PositionPoint>& position_points,
                                          const SweptSphere& sphere, const PathParams& params,
                                          const RoadmapParams& weights, const JobContext& job);

}  // namespace dollytrack::planning
