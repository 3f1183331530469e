#pragma once

#include "engine/camera/trajectory.h"
#include "render/scene/object_motion.h"

#include <string>
#include <vector>

namespace dollytrack::render {

/// SHA-256 of all poses and times of the whole trajectory. Frames that are not exported count, too,
/// because inertial measurements and motion blur interpolate over them.
[[nodiscard]] std::string trajectoryHash(const Trajectory& trajectory);

/// SHA-256 of all object motions over the whole trajectory.
[[nodiscard]] std::string motionsHash(const std::vector<ObjectMotion>& motions);

}  // namespace dollytrack::render
