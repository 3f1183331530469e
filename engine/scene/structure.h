#pragma once

#include "engine/scene/scene.h"

#include <vector>

namespace dollytrack {

/// Finds walls, floor, ceiling, grounds and skies by their shape among the objects whose name says
/// nothing (`undecided`, one flag an object), and gives them role and class.
void recogniseStructure(Scene& scene, const std::vector<bool>& undecided);

}  // namespace dollytrack
