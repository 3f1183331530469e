#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

#include <vector>

namespace dollytrack::planning {

class FreeSpace;
class SweptSphere;
struct LinkParams;

/// Joins separate parts of the roadmap in the same component of free space and room (paper, 3.2.3)
/// by RRT* between their closest position points. Samples come from a Gaussian chain that starts at
/// either end, r_{n+1} ~ N(r_n, sigma^2); one in five is uniform in free space, since the chain
/// alone may never leave a corner. Parts that cannot be joined stay separate; see Roadmap::group.
/// Error: Cancelled.
Status linkGroups(Roadmap& roadmap, const std::vector<PositionPoint>& position_points,
                  const std::vector<int>& key_frames, const FreeSpace& free_space,
                  const SweptSphere& sphere, const LinkParams& params, int seed,
                  const JobContext& job);

}  // namespace dollytrack::planning
