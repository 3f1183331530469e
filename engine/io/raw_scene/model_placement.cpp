#include "engine/io/raw_scene/model_placement.h"

#include "engine/io/raw_scene/mesh_part_builder.h"

#include <numeric>
#include <utility>

namespace dollytrack {

void ModelPlacement::addMaterials() {
    first_material_ = scene_.materials.size();
    const auto first_texture = static_cast<int>(scene_.textures.size());
    for (Material material : model_.materials) {
        visitTextures(material, [&](int& index) {
            if (index >= 0) index += first_texture;
        });
        scene_.materials.push_back(std::move(material));
    }
    scene_.textures.insert(scene_.textures.end(), model_.textures.begin(), model_.textures.end());
    scene_.repairs.add(model_.repairs);
    added_ = true;
}

std::vector<std::size_t> ModelPlacement::place(const std::string& name,
                                               const Eigen::Affine3d& scene_from_model) {
    std::vector<std::size_t> all(model_.parts.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return place(name, scene_from_model, all);
}

std::vector<std::size_t> ModelPlacement::place(const std::string& name,
                                               const Eigen::Affine3d& scene_from_model,
                                               const std::vector<std::size_t>& parts) {
    if (!added_) addMaterials();
    if (scene_.nodes.empty()) scene_.nodes.push_back({"", -1, 0});
    const int node = static_cast<int>(scene_.nodes.size());
    scene_.nodes.push_back({name, 0, 0});
    ++scene_.nodes.front().children;

    std::vector<std::size_t> placed;
    for (const std::size_t index : parts) {
        const MeshPart& part = model_.parts[index];
        std::vector<Eigen::Vector3f> uvs;
        for (const Eigen::Vector2f& uv : part.uvs) uvs.emplace_back(uv.x(), uv.y(), 0.0F);
        const std::vector<std::uint32_t> sizes(part.triangles.size(), 3);
        std::vector<std::uint32_t> indices;
        for (const Triangle& triangle : part.triangles) {
            indices.insert(indices.end(), triangle.begin(), triangle.end());
        }
        MeshPart moved;
        moved.name = part.name;
        moved.node = node;
        moved.material = part.material + static_cast<std::uint32_t>(first_material_);
        scene_.repairs.add(buildMeshPart({part.positions, part.normals, uvs, sizes, indices},
                                         scene_from_model, moved));
        placed.push_back(scene_.parts.size());
        scene_.parts.push_back(std::move(moved));
    }
    return placed;
}

}  // namespace dollytrack
