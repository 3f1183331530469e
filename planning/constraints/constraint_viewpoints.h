#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"
#include "planning/coverage/must_see.h"
#include "planning/coverage/surface_goal.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/hand_placed.h"

#include <optional>
#include <vector>

namespace dollytrack::planning {

class RoomPlan;

/// An anchor (doorway, opening or corridor) and the position points that visit it.
struct AnchorViewpoints {
    Anchors kind = Anchors::Doorways;
    std::vector<int> points;
};

/// Viewpoints extended by the ones that constraints ask for: must-see regions, anchors, room views,
/// surface views.
struct ConstraintViewpoints {
    PlacedPoints placed;
    std::vector<MustSee> must_see;
    std::optional<SurfaceGoal> surface;  // if the objective includes surface
    std::vector<TourRoom> tour_rooms;
    Anchors anchors = Anchors::None;  // kinds wanted by the constraints
    std::vector<AnchorViewpoints> found_anchors;
};

/// For each wanted kind, the number of anchors found, and how many have a viewpoint on the paths.
std::vector<AnchorTally> countAnchors(const ConstraintViewpoints& viewpoints_of_constraints,
                                      const std::vector<SmoothPath>& paths);

/// Whether the constraints need a RoomPlan.
bool asksForRooms(const ConstraintParams& constraints);

/// Adds viewpoints of must-see regions and anchors as fixed position points, and completes the
/// lists of objects that all points capture. Adds room views if wanted, and then surface views if
/// the objective includes surface, as many as the budget of frames leaves. Sets each point's room
/// if each room gets its own trajectory. `rooms` must be given if asksForRooms(). Error: Cancelled.
Result<ConstraintViewpoints> addConstraintViewpoints(const PlacedPoints& placed,
                                                     const std::vector<Region>& must_see,
                                                     const PlanParams& params,
                                                     const RoomPlan* rooms,
                                                     const PlanningEnvironment& environment,
                                                     VisibilityCache* memo, const JobContext& job);

}  // namespace dollytrack::planning
