#pragma once

#include "engine/camera/trajectory.h"
#include "engine/plan/plan.h"

#include <vector>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

/// Where the camera's centre comes nearest to a surface, to 0.1 mm: on its paths, and where a sway
/// takes it off them, on its moves from frame to frame (moveBetween()). Clearance changes no faster
/// than the camera moves, so pieces that cannot hold the least are left out unseen (branch and
/// bound); thin things cannot be missed. Without frames the result names no object.
TightestPlace findTightestPlace(const std::vector<SmoothPath>& paths, const Trajectory& trajectory,
                                const RayCaster& rays);

}  // namespace dollytrack::planning
