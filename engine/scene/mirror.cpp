#include "engine/scene/mirror.h"

#include "engine/scene/scene.h"

#include <algorithm>

namespace dollytrack {

bool isSmooth(const Material& material) {
    return material.roughness < kMirrorRoughness || material.roughness_map >= 0;
}

bool isMirror(const Material& material) {
    return isSmooth(material) && material.metallic > kMirrorMetal;
}

bool hasMaterial(const Scene& scene, const Object& object, bool (*that)(const Material& material)) {
    const auto first = scene.triangle_material.begin() + object.first_triangle;
    return std::any_of(first, first + object.triangle_count,
                       [&](std::uint32_t material) { return that(scene.materials[material]); });
}

}  // namespace dollytrack
