#pragma once

#include "engine/core/random.h"
#include "planning/viewpoints/viewpoint_search.h"

namespace dollytrack::planning {

/// Searches the best view of one observation point. Stages: in the cone around its direction; then,
/// only for a single object not captured well so far: all around, at random cells, from the
/// ceiling, and by an evolutionary search around the best candidates.
FoundView searchView(const PlanningEnvironment& environment, const ObservationPoint& point,
                     const ViewpointParams& params, Random random);

}  // namespace dollytrack::planning
