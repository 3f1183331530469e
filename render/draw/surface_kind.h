#pragma once

#include "engine/scene/scene.h"
#include "render/draw/gpu_scene.h"

#include <vector>

namespace dollytrack::render {

/// Of a cut-out, texels whose opacity is below are holes.
constexpr float kHoleBelow = 0.5F;

[[nodiscard]] inline bool isTextured(const Scene& scene, const Material& material) {
    return material.texture >= 0 && scene.textures[material.texture].width > 0;
}

/// Whether a map of a material is there.
[[nodiscard]] inline bool hasMap(const Scene& scene, int map) {
    return map >= 0 && scene.textures[static_cast<std::size_t>(map)].width > 0;
}

/// What a material shines with where no map says more; nothing where its map is missing.
[[nodiscard]] inline Eigen::Vector3f plainEmission(const Material& material) {
    return material.emission_map < 0 ? material.emission : Eigen::Vector3f::Zero();
}

/// How much of a material is metal, times its map where it has one; nothing where that is missing.
[[nodiscard]] inline float plainMetallic(const Scene& scene, const Material& material) {
    return material.metallic_map < 0 || hasMap(scene, material.metallic_map) ? material.metallic
                                                                             : 0.0F;
}

/// plainEmission() of all its surface in the mean.
[[nodiscard]] Eigen::Vector3f meanEmission(const Scene& scene, const Material& material);

/// Mean of a colour picture, linear.
[[nodiscard]] Eigen::Vector3f meanTexel(const Texture& texture);

/// How each material is shown, drawn or traced.
[[nodiscard]] std::vector<Surface> surfaceKinds(const Scene& scene);

}  // namespace dollytrack::render
