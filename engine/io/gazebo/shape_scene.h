#pragma once

#include "engine/io/gazebo/visuals.h"

namespace dollytrack::gazebo {

/// A box, cylinder, sphere or plane of the size 1, centred at the origin: one part without a
/// material.
[[nodiscard]] RawScene shapeScene(Visual::Shape kind);

}  // namespace dollytrack::gazebo
