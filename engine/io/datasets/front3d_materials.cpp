#include "engine/io/datasets/front3d_materials.h"

#include "engine/io/datasets/model_library.h"
#include "engine/io/files/bounded_json.h"
#include "engine/scene/srgb.h"

#include <algorithm>

namespace dollytrack {
namespace {

using nlohmann::json;

/// The id of a texture: the last folder of a URL like "https://host/i/<id>/wallfloor.jpg".
std::string idOfUrl(const std::string& url) {
    const auto last = url.rfind('/');
    if (last == std::string::npos || last == 0) return {};
    const auto before = url.rfind('/', last - 1);
    return before == std::string::npos ? url.substr(0, last)
                                       : url.substr(before + 1, last - before - 1);
}

}  // namespace

Front3dMaterials::Front3dMaterials(const json& document,
                                   const std::vector<std::filesystem::path>& folders,
                                   RawScene& scene)
    : folders_(folders), scene_(scene) {
    for (const json& source : listIn(document, "material")) {
        if (source.is_object()) entries_.try_emplace(textIn(source, "uid"), Entry{&source, -1});
    }
}

std::uint32_t Front3dMaterials::indexOf(const std::string& uid, std::vector<Eigen::Vector3f>& uvs) {
    const auto found = entries_.find(uid);
    if (found == entries_.end()) {
        if (plain_ < 0) plain_ = static_cast<int>(add(json::object()));
        return static_cast<std::uint32_t>(plain_);
    }
    Entry& entry = found->second;
    if (entry.index < 0) entry.index = static_cast<int>(add(*entry.source));
    // The offset is ignored, as in the dataset's own tools; a repeating texture is only shifted.
    const json::array_t& transform = listIn(*entry.source, "UVTransform");
    if (transform.size() == 9) {
        Eigen::Matrix2f turn;
        turn << static_cast<float>(numberIn(transform[0]).value_or(1.0)),
            static_cast<float>(numberIn(transform[1]).value_or(0.0)),
            static_cast<float>(numberIn(transform[3]).value_or(0.0)),
            static_cast<float>(numberIn(transform[4]).value_or(1.0));
        for (Eigen::Vector3f& uv : uvs) uv.head<2>() = (turn * uv.head<2>()).eval();
    }
    return static_cast<std::uint32_t>(entry.index);
}

std::uint32_t Front3dMaterials::add(const json& source) {
    Material material;
    material.name = textIn(source, "uid");
    const json::array_t& color = listIn(source, "color");
    if (color.size() >= 3) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double value = std::clamp(numberIn(color[i]).value_or(204.0), 0.0, 255.0);
            material.base_color[static_cast<Eigen::Index>(i)] =
                linearFromSrgb(static_cast<float>(value / 255.0));
        }
    }
    if (color.size() >= 4) {
        const double alpha = std::clamp(numberIn(color[3]).value_or(255.0) / 255.0, 0.0, 1.0);
        if (alpha > 0.0) material.opacity = static_cast<float>(alpha);
    }
    material.texture = textureOf(source);
    if (material.texture >= 0) material.base_color.setOnes();
    scene_.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

int Front3dMaterials::textureOf(const json& source) {
    const std::string url = textIn(source, "texture");
    const std::string url_id = idOfUrl(url);
    for (const std::string& id : {textIn(source, "jid"), url_id}) {
        if (!isPlainName(id)) continue;
        const auto file = findBelow(folders_, std::filesystem::path(id) / "texture.png");
        if (file) return request("texture.png", file->parent_path());
    }
    // A texture that is named but not found is reported as missing.
    if (isPlainName(url_id) && !folders_.empty()) {
        return request(url_id + "/texture.png", folders_.front());
    }
    return isPlainName(url_id) ? request("3D-FRONT-texture/" + url_id + "/texture.png", {}) : -1;
}

int Front3dMaterials::request(const std::string& name, const std::filesystem::path& folder) {
    const auto [at, is_new] =
        textures_.try_emplace(folder / name, static_cast<int>(scene_.textures.size()));
    if (is_new) {
        TextureRequest texture;
        texture.name = name;
        texture.folder = folder;
        texture.only_there = true;  // all of them are called texture.png
        scene_.textures.push_back(std::move(texture));
    }
    return at->second;
}

}  // namespace dollytrack
