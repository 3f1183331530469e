#pragma once

#include "engine/document/edits.h"
#include "engine/plan/plan.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <vector>

namespace dollytrack::planning {

class ShownMemo;

/// Points as they are after what a person placed and removed by hand.
struct PlacedPoints {
    Viewpoints viewpoints;
    std::vector<RefusedPin> refused;
};

/// Puts pinned points in the place of those that the search found for the same objects, adds the
/// others, and takes removed ones out. A pin that is not legal is refused with its reason, and the
/// found one stays. Then completes what every point captures (see findCaptured()); a pin that was
/// placed from a view gets an observation point that stands for what it captures.
PlacedPoints placeByHand(const Viewpoints& found, const PlanEdits& edits,
                         const Surroundings& around, ShownMemo* memo = nullptr);

}  // namespace dollytrack::planning
