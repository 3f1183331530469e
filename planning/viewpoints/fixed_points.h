#pragma once

#include "engine/math/pose.h"
#include "planning/viewpoints/viewpoint_search.h"

namespace dollytrack::planning {

/// Adds a fixed position point (the trajectory passes through this very pose) and an observation
/// point for it, at lookedAt(). The lists of captured objects stay empty until findCaptured().
void addFixedPoint(const Pose& pose, const PlanningEnvironment& environment,
                   Viewpoints& viewpoints);

/// The surface point at the centre of a view, or a point 2 m ahead if there is none within 10 m.
Eigen::Vector3d lookedAt(const Pose& pose, const ViewEstimator& views);

}  // namespace dollytrack::planning
