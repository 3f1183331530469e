#pragma once

#include "planning/baselines/planner.h"

namespace dollytrack::planning {

/// The one view of a room that overlooks most of its floor plan: 3D-FRONT and its toolbox (Fu et
/// al., ICCV 2021). Taken: candidate places from a Delaunay triangulation of the plan, cameras 1.2
/// m high that look level, the view chosen by the visible area of the plan inside the lens's wedge;
/// 5.2 views a scene on average. Different: that average is met by giving a scene of few rooms five
/// views, each at least 1 m from the others; the corners of the plan are those of the room's box
/// and of its objects' footprints; every place must hold the camera's sphere.
Result<Flight> planBestView(const RivalScene& scene, const PlanParams& params, int seed,
                            const JobContext& job);

}  // namespace dollytrack::planning
