#include "render/formats/scenes/gltf_scene.h"

#include "engine/core/clean_text.h"
#include "engine/io/files/jpeg_writer.h"
#include "engine/io/files/png_writer.h"
#include "engine/jobs/parallel.h"
#include "render/materials/surface_kind.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = std::vector<std::uint8_t>;

constexpr int kJpegQuality = 92;

/// glTF stores roughness and metallic in one image; separate maps are omitted.
int surfaceMap(const Scene& scene, const Material& material) {
    const bool same = material.roughness_map == material.metallic_map;
    return same && hasMap(scene, material.roughness_map) ? material.roughness_map : -1;
}

/// The textures that a material uses in the file.
std::vector<int> picturesOf(const Scene& scene, const Material& material) {
    std::vector<int> there;
    for (const int map : {material.texture, material.normal_map, surfaceMap(scene, material),
                          material.emission_map}) {
        if (hasMap(scene, map)) there.push_back(map);
    }
    return there;
}

/// JPEG, as most textures originally were; PNG for textures with holes or numeric data.
Result<Bytes> encodeGltfScene(const Texture& texture, bool exact) {
    if (exact) {
        return encodePng(texture.width, texture.height, PngFormat::Rgba8, texture.rgba);
    }
    std::vector<std::uint8_t> rgb;
    rgb.reserve(texture.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
        rgb.insert(rgb.end(), &texture.rgba[i], &texture.rgba[i] + 3);
    }
    Result<Bytes> bytes = encodeJpeg(texture.width, texture.height, 3, kJpegQuality, rgb);
    if (!bytes) return fail(ErrorCode::Failed, bytes.error().message, texture.name);
    return bytes;
}

/// Adds the textures in use. Returns their numbers in the file by index in the scene.
Result<std::map<int, int>> addTextures(const Scene& scene, GlbBuilder& builder, Json& root) {
    std::map<int, int> numbers;
    std::set<int> numeric;
    for (const Material& material : scene.materials) {
        for (const int map : picturesOf(scene, material)) numbers[map] = 0;
        numeric.insert({material.normal_map, surfaceMap(scene, material)});
    }
    std::vector<int> used;
    for (auto& [texture, number] : numbers) {
        number = static_cast<int>(used.size());
        used.push_back(texture);
    }
    std::vector<Result<Bytes>> pictures(used.size());
    std::vector<char> exact(used.size());
    parallelFor(used.size(), [&](std::size_t i) {
        const Texture& texture = scene.textures[used[i]];
        exact[i] = numeric.contains(used[i]) || hasHoles(texture) ? 1 : 0;
        pictures[i] = encodeGltfScene(texture, exact[i] != 0);
    });
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!pictures[i]) return tl::unexpected(pictures[i].error());
        const int image =
            builder.addImage(cleanText(scene.textures[used[i]].name),
                             exact[i] != 0 ? "image/png" : "image/jpeg", *pictures[i]);
        root["textures"].push_back({{"source", image}});
    }
    return numbers;
}

Json toJson(const Eigen::Vector3f& v) {
    return Json::array(
        {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())});
}

Json materialJson(const Scene& scene, const Material& material,
                  const std::map<int, int>& textures) {
    const Eigen::Vector3f color = material.base_color.cwiseMax(0.0F).cwiseMin(1.0F);
    const auto share = [](float value) {
        return static_cast<double>(std::clamp(value, 0.0F, 1.0F));
    };
    // If its metallic map is omitted, the material must not become metallic everywhere.
    const bool whole =
        material.metallic_map < 0 || surfaceMap(scene, material) == material.metallic_map;
    Json surface = {{"baseColorFactor",
                     {static_cast<double>(color.x()), static_cast<double>(color.y()),
                      static_cast<double>(color.z()), share(material.opacity)}},
                    {"metallicFactor", whole ? share(material.metallic) : 0.0},
                    {"roughnessFactor", share(material.roughness)}};
    Json json = {{"name", cleanText(material.name)}, {"doubleSided", true}};
    if (hasMap(scene, material.texture)) {
        surface["baseColorTexture"] = {{"index", textures.at(material.texture)}};
        if (hasHoles(scene.textures[material.texture])) {
            json["alphaMode"] = "MASK";
        }
    }
    if (const int map = surfaceMap(scene, material); map >= 0) {
        surface["metallicRoughnessTexture"] = {{"index", textures.at(map)}};
    }
    if (hasMap(scene, material.normal_map)) {
        json["normalTexture"] = {{"index", textures.at(material.normal_map)},
                                 {"scale", static_cast<double>(material.normal_scale)}};
    }
    if (material.opacity < 0.95F) json["alphaMode"] = "BLEND";
    json["pbrMetallicRoughness"] = std::move(surface);
    const bool shines = material.emission_map < 0 || hasMap(scene, material.emission_map);
    const float strength = shines ? material.emission.maxCoeff() : 0.0F;
    if (strength > 0.0F) {
        if (material.emission_map >= 0) {
            json["emissiveTexture"] = {{"index", textures.at(material.emission_map)}};
        }
        json["emissiveFactor"] =
            toJson(Eigen::Vector3f(material.emission.cwiseMax(0.0F) / std::max(strength, 1.0F)));
        if (strength > 1.0F) {
            json["extensions"]["KHR_materials_emissive_strength"] = {
                {"emissiveStrength", static_cast<double>(strength)}};
        }
    }
    return json;
}

/// An object's vertices relative to its node, and its triangles by material.
Json meshJson(const Scene& scene, const Object& object, GlbBuilder& builder) {
    const Eigen::Matrix3f turn = gltfFromWorld().toRotationMatrix().cast<float>();
    std::vector<Eigen::Vector3f> positions, normals;
    std::vector<Eigen::Vector2f> uvs;
    for (std::uint32_t v = object.first_vertex; v < object.first_vertex + object.vertex_count;
         ++v) {
        positions.push_back(turn *
                            (scene.positions[v].cast<double>() - object.box.center).cast<float>());
        const Eigen::Vector3f normal = turn * scene.normals[v];
        const bool unit = normal.allFinite() && normal.norm() > 1e-6F;
        normals.push_back(unit ? Eigen::Vector3f(normal.normalized()) : Eigen::Vector3f::UnitY());
        const Eigen::Vector2f& uv = scene.uvs[v];
        uvs.push_back(uv.allFinite() ? Eigen::Vector2f(uv.x(), 1.0F - uv.y())
                                     : Eigen::Vector2f::Zero());
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> corners;  // indices by material
    for (std::uint32_t t = object.first_triangle; t < object.first_triangle + object.triangle_count;
         ++t) {
        auto& list = corners[scene.triangle_material[t]];
        for (const std::uint32_t corner : scene.triangles[t]) {
            list.push_back(corner - object.first_vertex);
        }
    }
    const Json plain = {{"POSITION", builder.addVertices(positions)},
                        {"NORMAL", builder.addVertices(normals)}};
    Json textured;  // created only if a material needs texture coordinates
    Json primitives = Json::array();
    for (const auto& [material, list] : corners) {
        const bool picture = !picturesOf(scene, scene.materials[material]).empty();
        if (picture && textured.is_null()) {
            textured = plain;
            textured["TEXCOORD_0"] = builder.addVertices(uvs);
        }
        primitives.push_back({{"attributes", picture ? textured : plain},
                              {"indices", builder.addIndices(list)},
                              {"material", material}});
    }
    return {{"name", cleanText(object.name)}, {"primitives", std::move(primitives)}};
}

}  // namespace

Eigen::Quaterniond gltfFromWorld() {
    return Eigen::Quaterniond(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()));
}

Status addSceneNodes(const Scene& scene, GlbBuilder& builder, Json& root) {
    const Result<std::map<int, int>> textures = addTextures(scene, builder, root);
    if (!textures) return tl::unexpected(textures.error());
    bool strong_light = false;
    for (const Material& material : scene.materials) {
        root["materials"].push_back(materialJson(scene, material, *textures));
        strong_light = strong_light || material.emission.maxCoeff() > 1.0F;
    }
    if (strong_light) root["extensionsUsed"] = {"KHR_materials_emissive_strength"};
    for (const Object& object : scene.objects) {
        const Eigen::Vector3d at = gltfFromWorld() * object.box.center;
        Json node = {{"name", cleanText(object.name)},
                     {"translation", {at.x(), at.y(), at.z()}},
                     {"extras", {{"object_id", object.id}, {"nyu40", object.nyu40}}}};
        if (!scene.classes().isNyu40()) {
            const DatasetClass& of = scene.classes().classOf(object);
            node["extras"].update({{"class_id", of.id}, {"class", of.name}});
        }
        if (object.triangle_count > 0) {
            node["mesh"] = root.contains("meshes") ? root["meshes"].size() : 0;
            root["meshes"].push_back(meshJson(scene, object, builder));
        }
        root["nodes"].push_back(std::move(node));
    }
    return {};
}

}  // namespace dollytrack::render
