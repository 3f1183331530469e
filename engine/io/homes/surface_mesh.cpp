#include "engine/io/homes/surface_mesh.h"

#include "engine/io/raw_scene/mesh_part_builder.h"

#include <numeric>

namespace dollytrack::homes {

void SurfaceMesh::triangle(std::uint32_t material, const std::array<Eigen::Vector3d, 3>& corners,
                           const std::array<Eigen::Vector2d, 3>& uvs,
                           const Eigen::Vector3d& outward) {
    const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (!(normal.norm() > 1e-6)) return;
    std::array<std::size_t, 3> order = {0, 1, 2};
    if (normal.dot(outward) < 0.0) order = {0, 2, 1};
    Mesh& mesh = meshes_[material];
    for (const std::size_t i : order) {
        mesh.positions.push_back(corners[i].cast<float>());
        mesh.uvs.emplace_back(static_cast<float>(uvs[i].x()), static_cast<float>(uvs[i].y()), 0.0F);
    }
}

void SurfaceMesh::quad(std::uint32_t material, const std::array<Eigen::Vector3d, 4>& corners,
                       const Eigen::Vector3d& outward) {
    const std::array<Eigen::Vector2d, 3> uvs = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                                Eigen::Vector2d::Zero()};
    triangle(material, {corners[0], corners[1], corners[2]}, uvs, outward);
    triangle(material, {corners[0], corners[2], corners[3]}, uvs, outward);
}

std::vector<std::size_t> SurfaceMesh::addTo(RawScene& scene, const std::string& name) const {
    if (scene.nodes.empty()) scene.nodes.push_back({"", -1, 0});
    const int node = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back({name, 0, 0});
    ++scene.nodes.front().children;
    std::vector<std::size_t> added;
    for (const auto& [material, mesh] : meshes_) {
        const std::vector<std::uint32_t> sizes(mesh.positions.size() / 3, 3);
        std::vector<std::uint32_t> indices(mesh.positions.size());
        std::iota(indices.begin(), indices.end(), 0U);
        MeshPart part;
        part.name = name;
        part.node = node;
        part.material = material;
        RepairCounts repairs = buildMeshPart({mesh.positions, {}, mesh.uvs, sizes, indices},
                                             Eigen::Affine3d::Identity(), part);
        repairs.made_normals = 0;  // expected here
        scene.repairs.add(repairs);
        added.push_back(scene.parts.size());
        scene.parts.push_back(std::move(part));
    }
    return added;
}

}  // namespace dollytrack::homes
