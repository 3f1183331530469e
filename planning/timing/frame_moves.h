#pragma once

#include "engine/camera/trajectory.h"
#include "engine/plan/camera_path.h"

#include <vector>

namespace dollytrack::planning {

/// The camera's way from one frame of a path to the next, by curves that join: along the path, and
/// where a sway takes it off the path, as far beside it as the sway goes from the one frame to the
/// other. This is the one motion between frames: what is proven free, and what is measured.
std::vector<SmoothPath::Piece> moveBetween(const SmoothPath& path, const TrajectoryFrame& from,
                                           const TrajectoryFrame& to);

/// Whether the camera stands beside its path there, or its path is but a place.
[[nodiscard]] bool isOffPath(const SmoothPath& path, const TrajectoryFrame& frame);

}  // namespace dollytrack::planning
