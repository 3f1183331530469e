#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// Gives every object a front: away from the wall it stands or hangs at; else across its longer
/// side, towards the open; else towards the open around it.
void findFronts(Scene& scene);

}  // namespace dollytrack
