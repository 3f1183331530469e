#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

/// How a material is drawn.
enum class Surface {
    Opaque,
    CutOut,  // the texture has holes, as in leaves and lace
    Glass,   // transparent in the colour image, opaque in depth and labels
};

/// Texels of a cut-out texture with an opacity below this are holes.
constexpr float kHoleBelow = 0.5F;

[[nodiscard]] inline bool isTextured(const Scene& scene, const Material& material) {
    return material.texture >= 0 && scene.textures[material.texture].width > 0;
}

/// Whether a material's map (texture index, -1: none) exists and was loaded.
[[nodiscard]] inline bool hasMap(const Scene& scene, int map) {
    return map >= 0 && scene.textures[map].width > 0;
}

/// A material's emission if it has no emission map; zero if it has one.
[[nodiscard]] inline Eigen::Vector3f plainEmission(const Material& material) {
    return material.emission_map < 0 ? material.emission : Eigen::Vector3f::Zero();
}

/// Emission below this is not drawn: the surface shows reflected light only. Equal to kFaintest in
/// surface.frag.
constexpr float kFaintestEmission = 0.0625F;

/// A material's uniform emission as drawn; zero if it is below kFaintestEmission or if the material
/// has an emission map.
[[nodiscard]] inline Eigen::Vector3f drawnEmission(const Material& material) {
    const Eigen::Vector3f emission = plainEmission(material);
    return emission.maxCoeff() < kFaintestEmission ? Eigen::Vector3f::Zero().eval() : emission;
}

/// A material's metallic factor; its map, if any, multiplies it. 0 if the map was not loaded.
[[nodiscard]] inline float plainMetallic(const Scene& scene, const Material& material) {
    return material.metallic_map < 0 || hasMap(scene, material.metallic_map) ? material.metallic
                                                                             : 0.0F;
}

/// Whether a texture makes its surface a cut-out: more than 1 % of its texels are holes. Compressed
/// images often contain a few by accident.
[[nodiscard]] bool hasHoles(const Texture& texture);

/// Mean emission over the material's surface: its emission times the mean of its map.
[[nodiscard]] Eigen::Vector3f meanEmission(const Scene& scene, const Material& material);

/// Mean of a colour texture, linear, from at most 8191 texels; 1 for an empty texture.
[[nodiscard]] Eigen::Vector3f meanTexel(const Texture& texture);

/// Surface kind of each material, for the rasteriser and the path tracer.
[[nodiscard]] std::vector<Surface> surfaceKinds(const Scene& scene);

}  // namespace dollytrack::render
