#include "app/view/surface_colors.h"

#include "engine/scene/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::view {
namespace {

constexpr int kRows = 4;  // rows of sample points in a triangle; 10 points in total

const std::array<float, 256>& linearTable() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = linearFromSrgb(static_cast<float>(i) / 255.0F);
        }
        return values;
    }();
    return table;
}

/// Pixel index along one axis for a texture coordinate; the texture repeats.
int pixelAt(float coordinate, int size) {
    const float part = coordinate - std::floor(coordinate);
    if (!(part >= 0.0F)) return 0;  // NaN
    return std::min(static_cast<int>(part * static_cast<float>(size)), size - 1);
}

Eigen::Vector3f texel(const Texture& texture, const Eigen::Vector2f& uv) {
    const int x = pixelAt(uv.x(), texture.width);
    const int y = pixelAt(1.0F - uv.y(), texture.height);
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
             static_cast<std::size_t>(x));
    const auto& table = linearTable();
    return {table[texture.rgba[at]], table[texture.rgba[at + 1]], table[texture.rgba[at + 2]]};
}

/// Mean texture colour of a triangle; white without a texture.
Eigen::Vector3f meanTexel(const Scene& scene, int texture_index, const Triangle& corners) {
    if (texture_index < 0) return Eigen::Vector3f::Ones();
    const Texture& texture = scene.textures[texture_index];
    if (texture.width < 1 || texture.height < 1 || texture.rgba.empty()) {
        return Eigen::Vector3f::Ones();
    }
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int count = 0;
    for (int a = 0; a < kRows; ++a) {
        for (int b = 0; a + b < kRows; ++b) {
            const float u = (static_cast<float>(a) + 1.0F / 3.0F) / kRows;
            const float v = (static_cast<float>(b) + 1.0F / 3.0F) / kRows;
            sum += texel(texture, (1.0F - u - v) * scene.uvs[corners[0]] +
                                      u * scene.uvs[corners[1]] + v * scene.uvs[corners[2]]);
            ++count;
        }
    }
    return sum / static_cast<float>(count);
}

std::uint8_t srgbByte(float linear) {
    const float value = std::clamp(linear, 0.0F, 1.0F);
    const float srgb =
        value <= 0.0031308F ? 12.92F * value : 1.055F * std::pow(value, 1.0F / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(255.0F * srgb));
}

}  // namespace

Eigen::Vector3f triangleColor(const Scene& scene, std::uint32_t triangle) {
    const Material& material = scene.materials[scene.triangle_material[triangle]];
    const Triangle& corners = scene.triangles[triangle];
    Eigen::Vector3f color =
        material.base_color.cwiseProduct(meanTexel(scene, material.texture, corners));
    if (!material.emission.isZero()) {
        color += material.emission.cwiseProduct(meanTexel(scene, material.emission_map, corners));
    }
    return color;
}

bool isClear(const Scene& scene, std::uint32_t triangle) {
    return scene.materials[scene.triangle_material[triangle]].opacity < 0.5F;
}

std::array<std::uint8_t, 3> srgbBytes(const Eigen::Vector3f& linear) {
    return {srgbByte(linear.x()), srgbByte(linear.y()), srgbByte(linear.z())};
}

}  // namespace dollytrack::view
