#include "tests/engine/sandbox/serialized_scenes.h"

#include "engine/io/raw_scene/mesh_part_builder.h"

namespace dollytrack::test {

DecodedScene smallDecodedScene() {
    DecodedScene scene;
    RawScene& raw = scene.raw;
    raw.nodes = {{"root", -1, 2}, {"table", 0, 0}, {"lamp", 0, 0}};
    raw.materials.resize(2);
    raw.materials[0].name = "oak";
    raw.materials[0].texture = 0;
    raw.materials[1].emission = {4.0F, 4.0F, 3.0F};
    raw.materials[1].normal_map = 1;
    raw.materials[1].normal_scale = 0.5F;
    raw.materials[1].roughness_map = 0;
    raw.materials[1].metallic_map = 2;
    raw.materials[1].emission_map = 0;
    for (int i = 0; i < 2; ++i) {
        MeshPart part;
        part.name = i == 0 ? "table_top" : "bulb";
        part.node = 1 + i;
        part.material = static_cast<std::uint32_t>(i);
        const float z = static_cast<float>(i);
        part.positions = {{0, 0, z}, {1, 0, z}, {1, 2, z}, {0, 2, z}};
        part.normals.assign(4, Eigen::Vector3f::UnitZ());
        part.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        part.triangles = {{0, 1, 2}, {0, 2, 3}};
        measurePart(part);
        raw.parts.push_back(part);
    }
    raw.objects = {{"table", "dining table", 7, false, {0}, Eigen::Vector3d(1, 0, 0)},
                   {"lamp", "lamp", 35, false, {1}, std::nullopt}};
    for (const char* name : {"oak.png", "gone.png", "broken.png"}) {
        TextureRequest request;
        request.name = name;
        raw.textures.push_back(request);
        scene.textures.textures.push_back({name, 0, 0, {}});
    }
    scene.textures.textures[0].width = 2;
    scene.textures.textures[0].height = 1;
    scene.textures.textures[0].rgba = {1, 2, 3, 4, 5, 6, 7, 8};
    scene.textures.found = 1;
    scene.textures.missing = {"gone.png"};
    scene.textures.broken = {"broken.png"};
    raw.repairs.no_area = 3;
    raw.file_unit_m = 0.01;
    raw.file_up_axis = 'y';
    raw.file_from_parts = Eigen::Translation3d(1, 2, 3) * Eigen::Scaling(2.0);
    raw.notes = {"one thing worth knowing"};
    raw.warnings = {"one thing to look at"};
    return scene;
}

std::vector<std::uint8_t> serialized(const Result<DecodedScene>& outcome) {
    std::vector<std::uint8_t> bytes(serializedSize(outcome));
    serializeScene(outcome, bytes);
    return bytes;
}

}  // namespace dollytrack::test
