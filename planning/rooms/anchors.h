#pragma once

#include "engine/math/pose.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <vector>

namespace dollytrack::planning {

class RoomPlan;

/// One anchor with the views of it: none where the camera finds no place there.
struct AnchorViews {
    Anchors kind = Anchors::Doorways;  // one kind, never None or All
    std::vector<Pose> views;
};

/// The kinds that are asked for, in their order.
std::vector<Anchors> anchorKinds(Anchors wanted);

/// Views at what joins and opens rooms, where the camera may be: in each doorway, looking from the
/// larger room into the smaller one; before each opening in a wall, looking out; at both ends of
/// each corridor, looking along it. One entry an anchor of the scene.
std::vector<AnchorViews> anchorViews(const RoomPlan& rooms, Anchors wanted,
                                     const Surroundings& around);

}  // namespace dollytrack::planning
