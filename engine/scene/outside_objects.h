#pragma once

#include "engine/scene/scene.h"

#include <vector>

namespace dollytrack {

/// Targets whose boxes lie outside the building, beside or above all its walls and ceilings: garden
/// chairs, cars, objects on a roof. By rising id. Empty if the scene has no building, or if most
/// targets would be outside.
[[nodiscard]] std::vector<int> findOutsideObjects(const Scene& scene);

}  // namespace dollytrack
