#pragma once

#include "engine/camera/trajectory.h"
#include "engine/plan/plan.h"

#include <vector>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

/// Finds the minimum clearance of the camera's centre to a surface, to 0.1 mm, on the paths and,
/// where shake moves the camera off them, on its moves between frames (see moveBetween()). Branch
/// and bound: clearance changes no faster than the camera moves, so pieces that cannot contain the
/// minimum are skipped, and no thin object is missed. Without frames, object_id is 0.
MinimumClearance findMinimumClearance(const std::vector<SmoothPath>& paths,
                                      const Trajectory& trajectory, const RayCaster& rays);

}  // namespace dollytrack::planning
