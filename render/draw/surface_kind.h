#pragma once

#include "engine/scene/scene.h"
#include "render/draw/gpu_scene.h"

#include <vector>

namespace dollytrack::render {

/// Texels of a cut-out texture with an opacity below this are holes.
constexpr float kHoleBelow = 0.5F;

[[nodiscard]] inline bool isTextured(const Scene& scene, const Material& material) {
    return material.texture >= 0 && scene.textures[material.texture].width > 0;
}

/// Whether a material's map (texture index, -1: none) exists and was loaded.
[[nodiscard]] inline bool hasMap(const Scene& scene, int map) {
    return map >= 0 && scene.textures[static_cast<std::size_t>(map)].width > 0;
}

/// A material's emission if it has no emission map; zero if it has one.
[[nodiscard]] inline Eigen::Vector3f plainEmission(const Material& material) {
    return material.emission_map < 0 ? material.emission : Eigen::Vector3f::Zero();
}

/// A material's metallic factor; its map, if any, multiplies it. 0 if the map was not loaded.
[[nodiscard]] inline float plainMetallic(const Scene& scene, const Material& material) {
    return material.metallic_map < 0 || hasMap(scene, material.metallic_map) ? material.metallic
                                                                             : 0.0F;
}

/// Mean emission over the material's surface: its emission times the mean of its map.
[[nodiscard]] Eigen::Vector3f meanEmission(const Scene& scene, const Material& material);

/// Mean of a colour texture, linear, from at most 8191 texels; 1 for an empty texture.
[[nodiscard]] Eigen::Vector3f meanTexel(const Texture& texture);

/// Surface kind of each material, for the rasteriser and the path tracer.
[[nodiscard]] std::vector<Surface> surfaceKinds(const Scene& scene);

}  // namespace dollytrack::render
