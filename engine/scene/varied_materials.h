#pragma once

#include "engine/scene/light_params.h"
#include "engine/scene/scene.h"

namespace dollytrack {

/// Changes colours by at most a fifth and roughness by at most 0.15 (where light_variation is 1),
/// each material's by its index and the seed; nothing where light_variation is 0.
void varyMaterials(Scene& scene, const LightParams& params);

}  // namespace dollytrack
