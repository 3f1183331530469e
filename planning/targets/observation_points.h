#pragma once

#include "engine/plan/targets.h"

#include <vector>

namespace dollytrack::planning {

class ViewEstimator;
struct TargetParams;
struct ViewpointParams;

/// Makes the set O (paper, 3.2.1-3.2.2): one observation point per group of small objects on the
/// same supporting surface, and one for every other target. A group is split until one view shows
/// each member's box with at least 10 % of the image. Directions include the yaw and pitch offsets.
std::vector<ObservationPoint> setObservationPoints(const ViewEstimator& views,
                                                   const TargetParams& targets,
                                                   const ViewpointParams& viewpoints);

/// Observation point of one object of a group, with the group's direction.
ObservationPoint alone(const ViewEstimator& views, const ObservationPoint& group, int object_id);

}  // namespace dollytrack::planning
