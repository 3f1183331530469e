#pragma once

#include "engine/camera/trajectory.h"
#include "engine/plan/camera_path.h"

#include <vector>

namespace dollytrack::planning {

/// The camera's motion from one frame to the next, as connected curves: along the path, plus an
/// offset interpolated linearly in arc length between the frames' offsets from the path (by shake).
/// The next frame may be one that was left out, see motionFrames(). This motion is the one proven
/// collision-free and measured.
std::vector<SmoothPath::Piece> moveBetween(const SmoothPath& path, const TrajectoryFrame& from,
                                           const TrajectoryFrame& to);

/// Whether the frame is off its path, or the path has no length.
[[nodiscard]] bool isOffPath(const SmoothPath& path, const TrajectoryFrame& frame);

}  // namespace dollytrack::planning
