#pragma once

#include "planning/coverage/surface_goal.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <cstddef>
#include <vector>

namespace dollytrack::planning {

struct PlanParams;

/// The surface to be covered, and views for it.
struct SurfaceViews {
    SurfaceGoal goal;
    std::vector<Pose> views;  // the one that adds most comes first
};

/// Divides the surface visible from 300 to 600 positions, spread over the free space, into patches
/// of 0.1 m, or larger ones so that there are at most 4000, and chooses views at these positions by
/// greedy maximum coverage: a patch counts when it is seen first, and less for each further
/// direction in which it is seen sharply. `given` views count as chosen. Stops when 99 % of what is
/// possible is shown, or after `most` views. Deterministic. Error: Cancelled.
Result<SurfaceViews> findSurfaceViews(const PlanningEnvironment& environment,
                                      const PlanParams& params, const std::vector<Pose>& given,
                                      std::size_t most, const JobContext& job);

}  // namespace dollytrack::planning
