#include "render/materials/surface_kind.h"

#include "engine/scene/srgb.h"

#include <algorithm>

namespace dollytrack::render {

bool hasHoles(const Texture& texture) {
    std::size_t holes = 0;
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4) holes += texture.rgba[i] < 128 ? 1 : 0;
    return holes * 4 > texture.rgba.size() / 100;
}

Eigen::Vector3f meanTexel(const Texture& texture) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::size_t count = texture.rgba.size() / 4;
    const std::size_t step = std::max<std::size_t>(count / 4096, 1);
    std::size_t taken = 0;
    for (std::size_t i = 0; i < count; i += step, ++taken) {
        for (int c = 0; c < 3; ++c) {
            sum[c] += linearFromSrgb(
                static_cast<float>(texture.rgba[4 * i + static_cast<std::size_t>(c)]) / 255.0F);
        }
    }
    return taken == 0 ? Eigen::Vector3f::Ones()
                      : Eigen::Vector3f((sum / static_cast<double>(taken)).cast<float>());
}

Eigen::Vector3f meanEmission(const Scene& scene, const Material& material) {
    if (!hasMap(scene, material.emission_map)) return plainEmission(material);
    const Texture& map = scene.textures[material.emission_map];
    return material.emission.cwiseProduct(meanTexel(map));
}

std::vector<Surface> surfaceKinds(const Scene& scene) {
    std::vector<bool> holes;
    for (const Texture& texture : scene.textures) holes.push_back(hasHoles(texture));
    std::vector<Surface> kinds;
    for (const Material& material : scene.materials) {
        Surface kind = Surface::Opaque;
        if (material.opacity < 0.95F) {
            kind = Surface::Glass;
        } else if (isTextured(scene, material) && holes[material.texture]) {
            kind = Surface::CutOut;
        }
        kinds.push_back(kind);
    }
    return kinds;
}

}  // namespace dollytrack::render
