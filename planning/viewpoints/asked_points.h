#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"
#include "planning/coverage/must_see.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/hand_placed.h"

#include <vector>

namespace dollytrack::planning {

class RoomPlan;

/// An anchor and the position points that visit it.
struct AskedAnchor {
    Anchors kind = Anchors::Doorways;
    std::vector<int> points;
};

/// Points with those added that a person asks for beside the objects', each with its room.
struct AskedPoints {
    PlacedPoints placed;
    std::vector<MustSee> must_see;
    std::vector<TourRoom> tour_rooms;
    Anchors anchors = Anchors::None;  // the kinds asked for
    std::vector<AskedAnchor> found_anchors;
};

/// The anchors of each kind asked for, and how many of them have a view on the way.
std::vector<AnchorTally> countAnchors(const AskedPoints& asked,
                                      const std::vector<SmoothPath>& paths);

/// Whether the plan of rooms is needed.
bool asksForRooms(const ConstraintParams& constraints);

/// Adds the views of must-see regions and of anchors as fixed points and completes what they
/// capture, adds room views as far as the budget allows, and numbers the rooms when each has a
/// trajectory of its own. `rooms` is given when asksForRooms(). Error: Cancelled.
Result<AskedPoints> addAskedPoints(const PlacedPoints& placed, const std::vector<Region>& must_see,
                                   const PlanParams& params, const RoomPlan* rooms,
                                   const Surroundings& around, ShownMemo* memo,
                                   const JobContext& job);

}  // namespace dollytrack::planning
