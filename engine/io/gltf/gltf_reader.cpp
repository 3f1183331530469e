#include "engine/io/gltf/gltf_reader.h"

#include "engine/io/gltf/gltf_materials.h"
#include "engine/io/gltf/gltf_mesh.h"
#include "engine/io/gltf/gltf_nodes.h"
#include "engine/io/raw_scene/mesh_part_builder.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
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

/// Multiplies the base colour of a mesh by the mean of its vertex colours.
void useVertexColors(const std::vector<Task>& tasks, RawScene& raw) {
    constexpr float kSteps = 255.0F;
    std::map<std::tuple<std::uint32_t, int, int, int>, std::uint32_t> made;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const auto& color = tasks[i].primitive->mean_color;
        MeshPart& part = raw.parts[i];
        if (!color || raw.materials[part.material].texture >= 0) continue;
        const Eigen::Vector3i steps = (*color * kSteps).array().round().cast<int>();
        if ((steps.array() == static_cast<int>(kSteps)).all()) continue;
        const auto key = std::tuple(part.material, steps.x(), steps.y(), steps.z());
        const auto [found, is_new] =
            made.try_emplace(key, static_cast<std::uint32_t>(raw.materials.size()));
        if (is_new) {
            Material material = raw.materials[part.material];
            material.base_color = material.base_color.cwiseProduct(*color);
            raw.materials.push_back(std::move(material));
        }
        part.material = found->second;
    }
}

/// Reads each mesh that has a placement once; other meshes stay empty.
std::vector<std::vector<Primitive>> readPlacedMeshes(
    const Document& document, const std::vector<PictureCoordinates>& coordinates, bool keep_colors,
    const std::vector<MeshPlacement>& placements, const JobContext& job) {
    std::vector<std::size_t> used;
    for (const MeshPlacement& placement : placements) used.push_back(placement.mesh);
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (!used.empty()) static_cast<void>(document.entry("meshes", used.back()));  // throws
    std::vector<std::vector<Primitive>> meshes(used.empty() ? 0 : used.back() + 1);
    parallelFor(used.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        meshes[used[i]] = readMesh(document, used[i], coordinates, keep_colors);
    });
    return meshes;
}

RawScene read(const Document& document, const JobContext& job) {
    RawScene raw;
    raw.file_unit_m = 1.0;
    raw.file_up_axis = 'y';
    const std::vector<PictureCoordinates> coordinates = readMaterials(document, raw);
    std::vector<MeshPlacement> placements = placeMeshes(document, raw);
    const auto meshes = readPlacedMeshes(document, coordinates, false, placements, job);
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
    useVertexColors(tasks, raw);
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
        all.meshes = readPlacedMeshes(document, coordinates, true, all.placements, job);
        all.scene.nodes.clear();
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled", where);
        return all;
    } catch (const Fault& fault) {
        return fail(ErrorCode::BadInput, fault.what(), where);
    }
}

}  // namespace dollytrack::gltf
