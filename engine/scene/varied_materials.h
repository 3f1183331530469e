#pragma once

#include "engine/scene/light_params.h"
#include "engine/scene/scene.h"

namespace dollytrack {

/// Varies materials at random: base colours by at most a fifth and roughness by at most 0.15 at
/// light_variation 1, nothing at 0. The values depend on light_seed and the material's index.
void varyMaterials(Scene& scene, const LightParams& params);

}  // namespace dollytrack
