#pragma once

#include "engine/scene/scene.h"

#include <vector>

namespace dollytrack {

/// Targets that lie outside the building by their boxes: beside or above all its walls and
/// ceilings, such as garden chairs, cars and what stands on a roof. By rising id. Empty where the
/// scene has no building, or where most targets would be outside it.
[[nodiscard]] std::vector<int> findOutsideObjects(const Scene& scene);

}  // namespace dollytrack
