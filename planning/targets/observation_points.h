#pragma once

#include "engine/plan/targets.h"

#include <vector>

namespace dollytrack::planning {

class ViewEstimator;
struct TargetParams;
struct ViewpointParams;

/// Sets O (paper, 3.2.1-3.2.2): one for every target by itself, and one for every group of small
/// objects that share a carrier as far as one view can hold them at a useful size; larger groups
/// are split. Directions include the yaw and pitch offsets.
std::vector<ObservationPoint> setObservationPoints(const ViewEstimator& views,
                                                   const TargetParams& targets,
                                                   const ViewpointParams& viewpoints);

/// The observation point of one object of a group that is to be seen by itself.
ObservationPoint alone(const ViewEstimator& views, const ObservationPoint& group, int object_id);

}  // namespace dollytrack::planning
