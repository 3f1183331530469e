#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack {

/// An 8-bit RGBA image, rows from the top. Colours are sRGB encoded; other data (normals,
/// roughness, metallic) is linear.
struct Texture {
    std::string name;  // as the scene names it, clean text (core/clean_text.h)
    int width = 0;     // 0 when the file was not found or not readable
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Metallic-roughness material; colours are linear.
struct Material {
    std::string name;
    Eigen::Vector3f base_color = {0.8F, 0.8F, 0.8F};
    float opacity = 1.0F;
    Eigen::Vector3f emission = {0.0F, 0.0F, 0.0F};
    float metallic = 0.0F;
    float roughness = 0.8F;
    int texture = -1;  // index into Scene::textures, multiplies base_color; -1: none

    // Maps, as glTF 2.0 has them: indices into Scene::textures; -1: none.
    int normal_map = -1;     // in tangent space: u, v (upwards), normal
    float normal_scale = 1;  // scales its u and v components
    int roughness_map = -1;  // green, multiplies roughness
    int metallic_map = -1;   // blue, multiplies metallic
    int emission_map = -1;   // multiplies emission

    [[nodiscard]] bool hasMaps() const {
        return normal_map >= 0 || roughness_map >= 0 || metallic_map >= 0 || emission_map >= 0;
    }
};

/// Calls `visit` with each of the material's texture indices, which it may change.
template <class AnyMaterial, class Visitor>
void visitTextures(AnyMaterial& material, Visitor&& visit) {
    visit(material.texture);
    visit(material.normal_map);
    visit(material.roughness_map);
    visit(material.metallic_map);
    visit(material.emission_map);
}

}  // namespace dollytrack
