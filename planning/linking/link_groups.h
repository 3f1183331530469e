#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

#include <vector>

namespace dollytrack::planning {

class FreeSpace;
class SweptSphere;
struct LinkParams;

/// Joins the parts of the roadmap that lie in one component of free space (paper, 3.2.3): RRT*
/// between the closest position points of two parts, with samples from a Gaussian chain that
/// starts at either end, r_{n+1} ~ N(r_n, sigma^2), and one in five uniform in free space so that
/// it cannot starve. Parts that cannot be joined stay; `group` tells. Error: Cancelled.
Status linkGroups(Roadmap& roadmap, const std::vector<PositionPoint>& position_points,
                  const std::vector<int>& key_frames, const FreeSpace& free_space,
                  const SweptSphere& sphere, const LinkParams& params, int seed,
                  const JobContext& job);

}  // namespace dollytrack::planning
