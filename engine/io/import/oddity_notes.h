#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// Says what is unusual about a finished scene and yet right: several storeys, faces that are there
/// from both sides, things inside out, mirrors that mirror nothing. It changes nothing; planning
/// and pictures take all of them as they are.
void noteOddities(const Scene& scene, ImportReport& report);

}  // namespace dollytrack
