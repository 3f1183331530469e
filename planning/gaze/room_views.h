#pragma once

#include "planning/viewpoints/viewpoint_search.h"

namespace dollytrack::planning {

struct PlanParams;

/// Whether room views are wanted (view_mix above 0, and objects are an objective) and possible: a
/// tour with free heading, without max_length_m and without a kept frame rate (see keepsFrameRate).
[[nodiscard]] bool asksForRoomViews(const PlanParams& params);

/// Adds views that show many objects at once from the middle of the rooms, at eye level, as
/// position points marked room_view, each with an observation point where it looks. Their number is
/// at most about two per key frame, fewer with a small view_mix or budget of frames, and fewer
/// where further views would add little. Greedy maximum coverage with diminishing returns: an
/// object counts less the more views show it, above all from the same side; the gain is weighed
/// against the distance from the other key frames. Each view lies in a component of free space that
/// holds key frames.
void addRoomViews(const PlanParams& params, const PlanningEnvironment& environment,
                  Viewpoints& viewpoints);

}  // namespace dollytrack::planning
