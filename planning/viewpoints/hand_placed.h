#pragma once

#include "engine/document/edits.h"
#include "engine/plan/plan.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <vector>

namespace dollytrack::planning {

class VisibilityCache;

/// Viewpoints after manual edits, and the pins that were refused.
struct PlacedPoints {
    Viewpoints viewpoints;
    std::vector<RefusedPin> refused;
};

/// Applies manual edits: a pinned point replaces the point found for the same objects or is added;
/// removed points are dropped. An illegal pin is refused with a reason, and the found point stays.
/// Then completes what each point captures, by findCaptured(). A pin made from a view gets an
/// observation point for the objects it captures.
PlacedPoints placeByHand(const Viewpoints& found, const PlanEdits& edits,
                         const PlanningEnvironment& environment, VisibilityCache* memo = nullptr);

}  // namespace dollytrack::planning
