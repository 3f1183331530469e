#pragma once

#include "engine/math/pose.h"
#include "planning/viewpoints/viewpoint_search.h"

namespace dollytrack::planning {

/// Adds a position point that the trajectory goes through at this very pose, with an observation
/// point where it looks. It stands for no object; what it captures is for findCaptured() to say.
void addFixedPoint(const Pose& pose, const Surroundings& around, Viewpoints& viewpoints);

/// Where a view looks: the surface it meets, or a little way on where it meets none near by.
Eigen::Vector3d lookedAt(const Pose& pose, const ViewEstimator& views);

}  // namespace dollytrack::planning
