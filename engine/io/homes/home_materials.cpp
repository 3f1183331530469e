#include "engine/io/homes/home_materials.h"

#include "engine/core/clean_text.h"

#include <fmt/format.h>

namespace dollytrack::homes {
namespace {

std::string keyOf(const HomeSurface& surface) {
    std::string key;
    if (surface.texture) key = "picture " + surface.texture->image;
    if (surface.color) {
        const Eigen::Vector3f& c = *surface.color;
        key += fmt::format(" {} {} {}", c.x(), c.y(), c.z());
    }
    return key;
}

}  // namespace

int HomeMaterials::texture(const std::string& image) {
    const auto [found, is_new] =
        textures_.try_emplace(image, static_cast<int>(scene_.textures.size()));
    if (!is_new) return found->second;
    TextureRequest request;
    request.name = image;
    const auto bytes = files_.read(image);
    if (bytes && *bytes) {
        request.embedded = **bytes;
    } else {
        scene_.notes.push_back("the texture " + cleanText(image) + " is not among the home's " +
                               "files");
    }
    scene_.textures.push_back(std::move(request));
    return found->second;
}

std::uint32_t HomeMaterials::of(const HomeSurface& surface, const Eigen::Vector3f& otherwise) {
    HomeSurface complete = surface;
    if (!complete.color && !complete.texture) complete.color = otherwise;
    const auto [found, is_new] =
        made_.try_emplace(keyOf(complete), static_cast<std::uint32_t>(scene_.materials.size()));
    if (!is_new) return found->second;
    Material material;
    material.name = "surface_" + std::to_string(made_.size());
    material.base_color =
        complete.texture ? Eigen::Vector3f::Ones() : complete.color.value_or(otherwise);
    if (complete.texture) material.texture = texture(complete.texture->image);
    scene_.materials.push_back(std::move(material));
    return found->second;
}

std::uint32_t HomeMaterials::overlaid(std::uint32_t material, const HomeSurface& surface) {
    if (!surface.color && !surface.texture) return material;
    const auto [found, is_new] =
        made_.try_emplace(fmt::format("{} over {}", keyOf(surface), material),
                          static_cast<std::uint32_t>(scene_.materials.size()));
    if (!is_new) return found->second;
    Material copy = scene_.materials[material];
    if (surface.texture) {
        copy.texture = texture(surface.texture->image);
        copy.base_color.setOnes();
    } else {
        copy.texture = -1;
        copy.base_color = *surface.color;
    }
    scene_.materials.push_back(std::move(copy));
    return found->second;
}

}  // namespace dollytrack::homes
