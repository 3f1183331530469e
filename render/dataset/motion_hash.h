#pragma once

#include "engine/camera/trajectory.h"
#include "render/frames/object_motion.h"

#include <string>
#include <vector>

namespace dollytrack::render {

/// SHA-256 of all poses and times of a trajectory, exported or not: inertial measurements and
/// motion blur follow a curve through all of them.
[[nodiscard]] std::string trajectoryHash(const Trajectory& trajectory);

/// SHA-256 of how things move over a whole trajectory.
[[nodiscard]] std::string motionsHash(const std::vector<ObjectMotion>& motions);

}  // namespace dollytrack::render
