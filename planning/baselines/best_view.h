#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// Baseline: the views that overlook most of each room's floor plan, as in 3D-FRONT and its toolbox
/// (Fu et al., ICCV 2021). As published: candidates from a Delaunay triangulation of the plan,
/// level cameras 1.2 m above the floor, chosen by the visible area of the plan inside the field of
/// view, 5.2 views per scene on average. Differences: a scene of fewer than five rooms gets five
/// views, at least 1 m apart; the corners of the plan are those of the room's bounding box and of
/// the objects' footprints; the camera sphere must fit at every candidate. Error: Cancelled.
Result<PlannedMotion> planBestView(const MappedScene& scene, const PlanParams& params, int seed,
                                   const JobContext& job);

}  // namespace dollytrack::planning
