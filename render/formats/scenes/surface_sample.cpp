#include "render/formats/scenes/surface_sample.h"

#include "engine/core/random.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::render {
namespace {

double linearOf(std::uint8_t srgb) {
    const double value = srgb / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

std::uint8_t srgbOf(double linear) {
    const double value = std::clamp(linear, 0.0, 1.0);
    const double encoded =
        value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

/// Nearest texel; textures repeat.
const std::uint8_t* texelAt(const Texture& texture, const Eigen::Vector2f& uv) {
    const auto wrapped = [](float value, int size) {
        const float inside = value - std::floor(value);
        return std::clamp(static_cast<int>(inside * static_cast<float>(size)), 0, size - 1);
    };
    const int x = wrapped(uv.x(), texture.width);
    const int y = wrapped(1.0F - uv.y(), texture.height);
    return &texture.rgba[4 * (static_cast<std::size_t>(y) * texture.width + x)];
}

std::array<std::uint8_t, 3> colorAt(const Scene& scene, std::uint32_t triangle,
                                    const Eigen::Vector2f& uv) {
    const Material& material = scene.materials[scene.triangle_material[triangle]];
    Eigen::Vector3d color = material.base_color.cast<double>();
    if (material.texture >= 0) {
        const Texture& texture = scene.textures[material.texture];
        if (texture.width > 0 && uv.allFinite()) {
            const std::uint8_t* texel = texelAt(texture, uv);
            for (int c = 0; c < 3; ++c) color[c] *= linearOf(texel[c]);
        }
    }
    return {srgbOf(color[0]), srgbOf(color[1]), srgbOf(color[2])};
}

}  // namespace

std::vector<ColoredPoint> sampleSurface(const Scene& scene, int count, std::uint64_t seed) {
    std::vector<double> area_up_to;  // cumulative area by triangle
    area_up_to.reserve(scene.triangles.size());
    double area = 0.0;
    for (const Triangle& corners : scene.triangles) {
        const Eigen::Vector3f& a = scene.positions[corners[0]];
        area += 0.5 * (scene.positions[corners[1]] - a)
                          .cross(scene.positions[corners[2]] - a)
                          .cast<double>()
                          .norm();
        area_up_to.push_back(area);
    }
    std::vector<ColoredPoint> points;
    if (!(area > 0.0)) return points;
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        const auto at = std::upper_bound(area_up_to.begin(), area_up_to.end(),
                                         random.uniform() * area_up_to.back());
        const auto triangle =
            std::min(static_cast<std::size_t>(at - area_up_to.begin()), scene.triangles.size() - 1);
        const Triangle& corners = scene.triangles[triangle];
        // The square root makes points uniform; otherwise they cluster at the first corner.
        const double root = std::sqrt(random.uniform());
        const double along = random.uniform();
        const Eigen::Vector3d share(1.0 - root, root * (1.0 - along), root * along);
        ColoredPoint point{Eigen::Vector3d::Zero(), {}};
        Eigen::Vector2f uv = Eigen::Vector2f::Zero();
        for (int c = 0; c < 3; ++c) {
            point.position += share[c] * scene.positions[corners[c]].cast<double>();
            uv += static_cast<float>(share[c]) * scene.uvs[corners[c]];
        }
        point.color = colorAt(scene, static_cast<std::uint32_t>(triangle), uv);
        points.push_back(point);
    }
    return points;
}

}  // namespace dollytrack::render
