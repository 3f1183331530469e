#include "render/surface_kind.h"

namespace dollytrack::render {

bool hasHoles(const Texture& texture) {
    std::size_t holes = 0;
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4) holes += texture.rgba[i] < 128 ? 1 : 0;
    return holes * 4 > texture.rgba.size() / 100;
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
