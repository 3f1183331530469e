#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// Notes unusual but supported properties of a finished scene: several storeys, no targets, objects
/// with doubled faces, objects that are inside out, mirrors without a reflective material. The
/// scene is not changed.
void noteOddities(const Scene& scene, ImportReport& report);

}  // namespace dollytrack
