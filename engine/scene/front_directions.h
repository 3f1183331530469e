#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// Sets the front direction of every object that has no annotated one: away from the wall that it
/// stands or hangs at. Without a wall an elongated object faces across its longer side, to where
/// the view is open farther; others face the open space around them.
void findFronts(Scene& scene);

}  // namespace dollytrack
