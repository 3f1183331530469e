#pragma once

#include "engine/math/pose.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <vector>

namespace dollytrack::planning {

class RoomPlan;

/// An anchor with views of it; none if the camera fits nowhere near it.
struct AnchorViews {
    Anchors kind = Anchors::Doorways;  // never None or All
    std::vector<Pose> views;
};

/// The single kinds that `wanted` includes, in their order.
std::vector<Anchors> anchorKinds(Anchors wanted);

/// Views of doorways, openings and corridors: in each doorway, looking from the larger room into
/// the smaller one; in front of each opening in a wall, looking out; at both ends of each corridor,
/// looking along it. One entry per anchor in the scene.
std::vector<AnchorViews> anchorViews(const RoomPlan& rooms, Anchors wanted,
                                     const PlanningEnvironment& environment);

}  // namespace dollytrack::planning
