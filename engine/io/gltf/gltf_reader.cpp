#include "engine/io/gltf/gltf_reader.h"

#include "engine/io/gltf/gltf_materials.h"
#include "engine/io/gltf/gltf_mesh.h"
#include "engine/io/gltf/gltf_nodes.h"
#include "engine/io/raw_scene/mesh_part_builder.h"
#include "engine/io/raw_scene/vertex_colors.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/srgb.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace dollytrack::gltf {
namespace {

/// One primitive under one node.
struct Task {
    const Primitive* primitive;
    const MeshPlacement* placement;
};

RepairCounts build(const Task& task, MeshPart& part) {
    const Primitive& primitive = *task.primitive;
    part.name = primitive.name;
    part.node = task.placement->node;
    part.material = primitive.material;
    const std::vector<std::uint32_t> sizes(primitive.indices.size() / 3, 3);
    SourceMesh source;
    source.positions = primitive.positions;
    source.normals = primitive.normals;
    source.uvs = primitive.uvs;
    source.face_sizes = sizes;
    source.face_indices = primitive.indices;
    RepairCounts counts = buildMeshPart(source, task.placement->source_from_mesh, part);
    counts.lines += primitive.lines;
    return counts;
}

/// Makes a texture of a primitive's vertex colours. If all vertices have the same colour,
/// multiplies the base colour by it instead.
void useVertexColors(Primitive& primitive, RawScene& raw) {
    if (primitive.colors.empty()) return;
    Material material = raw.materials[primitive.material];
    if (material.texture >= 0 || material.hasMaps()) return;
    std::vector<Eigen::Vector3f> colors;
    for (const Eigen::Vector3f& color : primitive.colors) {
        colors.push_back(color.cwiseMax(0.0F).unaryExpr(&srgbFromLinear));
    }
    const std::vector<std::uint32_t> sizes(primitive.indices.size() / 3, 3);
    SourceMesh mesh{primitive.positions, primitive.normals, primitive.uvs, sizes,
                    primitive.indices};
    if (std::optional<PaintedMesh> painted = paintVertexColors(mesh, colors)) {
        material.texture = static_cast<int>(raw.textures.size());
        raw.textures.push_back(std::move(painted->texture));
        primitive.positions = std::move(painted->positions);
        primitive.normals = std::move(painted->normals);
        primitive.uvs = std::move(painted->uvs);
        primitive.indices = std::move(painted->indices);
    } else {
        const Eigen::Vector3f& color = primitive.colors.front();
        if (!color.allFinite() || color.isOnes()) return;
        material.base_color = material.base_color.cwiseProduct(color.cwiseMax(0.0F).cwiseMin(1.0F));
    }
    primitive.material = static_cast<std::uint32_t>(raw.materials.size());
    raw.materials.push_back(std::move(material));
}

/// Reads each mesh that has a placement once; other meshes stay empty.
std::vector<std::vector<Primitive>> readPlacedMeshes(
    const Document& document, const std::vector<PictureCoordinates>& coordinates,
    const std::vector<MeshPlacement>& placements, const JobContext& job) {
    std::vector<std::size_t> used;
    for (const MeshPlacement& placement : placements) used.push_back(placement.mesh);
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (!used.empty()) static_cast<void>(document.entry("meshes", used.back()));  // throws
    std::vector<std::vector<Primitive>> meshes(used.empty() ? 0 : used.back() + 1);
    parallelFor(used.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        meshes[used[i]] = readMesh(document, used[i], coordinates);
    });
    return meshes;
}

RawScene read(const Document& document, const JobContext& job) {
    RawScene raw;
    raw.file_unit_m = 1.0;
    raw.file_up_axis = 'y';
    const std::vector<PictureCoordinates> coordinates = readMaterials(document, raw);
    std::vector<MeshPlacement> placements = placeMeshes(document, raw);
    auto meshes = readPlacedMeshes(document, coordinates, placements, job);
    for (std::vector<Primitive>& mesh : meshes) {
        for (Primitive& primitive : mesh) useVertexColors(primitive, raw);
    }
    std::vector<Task> tasks;
    for (const MeshPlacement& placement : placements) {
        for (const Primitive& primitive : meshes[placement.mesh]) {
            tasks.push_back({&primitive, &placement});
        }
    }
    raw.parts.resize(tasks.size());
    std::vector<RepairCounts> counts(tasks.size());
    parallelFor(tasks.size(), [&](std::size_t i) {
        if (!job.cancelled()) counts[i] = build(tasks[i], raw.parts[i]);
    });
    for (const RepairCounts& c : counts) raw.repairs.add(c);
    return raw;
}

}  // namespace

Result<RawScene> readGltf(std::string file, const ReadBeside& read_beside, const std::string& where,
                          const JobContext& job) {
    try {
        const Document document(std::move(file), read_beside);
        RawScene raw = read(document, job);
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", where);
        return raw;
    } catch (const Fault& fault) {
        return fail(ErrorCode::BadInput, fault.what(), where);
    }
}

Result<ColoredMeshes> readColoredMeshes(std::string file, const ReadBeside& read_beside,
                                        const std::string& where, const JobContext& job) {
    try {
        const Document document(std::move(file), read_beside);
        ColoredMeshes all;
        const std::vector<PictureCoordinates> coordinates = readMaterials(document, all.scene);
        all.placements = placeMeshes(document, all.scene);
        all.meshes = readPlacedMeshes(document, coordinates, all.placements, job);
        all.scene.nodes.clear();
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", where);
        return all;
    } catch (const Fault& fault) {
        return fail(ErrorCode::BadInput, fault.what(), where);
    }
}

}  // namespace dollytrack::gltf
