#pragma once

#include "engine/math/pose.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <vector>

namespace dollytrack::planning {

class RoomPlan;

/// Views at what joins and opens rooms, where the camera may be: in each doorway, looking from the
/// larger room into the smaller one; before each opening in a wall, looking out; at both ends of
/// each corridor, looking along it. Those for which there is no legal place are left out.
std::vector<Pose> anchorViews(const RoomPlan& rooms, Anchors wanted, const Surroundings& around);

}  // namespace dollytrack::planning
