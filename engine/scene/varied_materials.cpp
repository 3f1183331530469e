#include "engine/scene/varied_materials.h"

#include "engine/core/random.h"

#include <algorithm>
#include <cmath>

namespace dollytrack {

void varyMaterials(Scene& scene, const LightParams& params) {
    if (params.light_variation <= 0.0) return;
    constexpr std::uint64_t kFirstStream = 1000;  // the streams before are those of the light
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& material = scene.materials[i];
        Random random(static_cast<std::uint64_t>(params.light_seed), kFirstStream + i);
        const auto spread = [&](double most) {
            return random.uniform(-most, most) * params.light_variation;
        };
        const double brighter = spread(0.18);
        for (int c = 0; c < 3; ++c) {
            const double factor = std::exp2(brighter + spread(0.08));
            material.base_color[c] =
                std::min(material.base_color[c] * static_cast<float>(factor), 1.0F);
        }
        material.roughness =
            std::clamp(material.roughness + static_cast<float>(spread(0.15)), 0.0F, 1.0F);
    }
}

}  // namespace dollytrack
