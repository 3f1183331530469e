#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack {

/// An 8-bit RGBA picture, rows from the top, sRGB encoded.
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
};

}  // namespace dollytrack
