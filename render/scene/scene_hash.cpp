#include "render/scene/scene_hash.h"

#include "engine/io/files/sha256.h"

#include <array>
#include <span>
#include <type_traits>

namespace dollytrack::render {
namespace {

template <class T>
std::span<const std::uint8_t> bytesOf(const std::vector<T>& values) {
    static_assert(std::is_trivially_destructible_v<T>);
    return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)};
}

/// Hashes a list with its length, so that consecutive lists cannot be confused.
template <class T>
void add(Sha256& hash, const std::vector<T>& values) {
    hash.add(std::to_string(values.size()) + "\n");
    hash.add(bytesOf(values));
}

std::vector<float> numbersOf(const Material& material) {
    const Eigen::Vector3f& base = material.base_color;
    const Eigen::Vector3f& emission = material.emission;
    std::vector<float> numbers = {base.x(),           base.y(),
                                  base.z(),           emission.x(),
                                  emission.y(),       emission.z(),
                                  material.opacity,   material.metallic,
                                  material.roughness, static_cast<float>(material.texture)};
    if (material.hasMaps()) {  // scenes without maps keep their old hash
        for (const int index : {material.normal_map, material.roughness_map, material.metallic_map,
                                material.emission_map}) {
            numbers.push_back(static_cast<float>(index));
        }
        numbers.push_back(material.normal_scale);
    }
    return numbers;
}

}  // namespace

std::string geometryHash(const Scene& scene) {
    Sha256 hash;
    hash.add(bytesOf(scene.positions));
    hash.add(bytesOf(scene.triangles));
    for (const Object& object : scene.objects) {
        hash.add(object.name + "\n" + std::to_string(object.nyu40) + "\n");
    }
    return hash.finish();
}

std::string appearanceHash(const Scene& scene) {
    Sha256 hash;
    add(hash, scene.normals);
    add(hash, scene.uvs);
    add(hash, scene.triangle_material);
    for (const Material& material : scene.materials) add(hash, numbersOf(material));
    for (const Texture& texture : scene.textures) {
        hash.add(std::to_string(texture.width) + " " + std::to_string(texture.height) + "\n");
        add(hash, texture.rgba);
    }
    return hash.finish();
}

}  // namespace dollytrack::render
