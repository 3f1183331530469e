#pragma once

#include "engine/core/random.h"
#include "planning/viewpoints/viewpoint_search.h"

namespace dollytrack::planning {

/// The search for one observation point: in the cone around its direction first; for a single
/// object that no place there captures well, all around it, anywhere in free space, and at last
/// closer and closer to the places that nearly do.
FoundView searchView(const Surroundings& around, const ObservationPoint& point,
                     const ViewpointParams& params, Random random);

}  // namespace dollytrack::planning
