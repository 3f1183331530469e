// Which textures of a material are imported, and as which maps.

#include "engine/io/import/scene_import.h"
#include "tests/support/imported_scene.h"
#include "tests/support/obj_writer.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <cstring>

namespace dollytrack::material_maps_test {
namespace {

using test::find;
using test::imported;
using test::ObjWriter;
using test::TempFolder;

/// A texture of one texel.
std::string picture(const std::string& rgb) {
    return "P6\n1 1\n255\n" + rgb;
}

const Material& materialOf(const Scene& scene, const char* object) {
    return scene.materials[scene.triangle_material[find(scene, object)->first_triangle]];
}

std::string nameOf(const Scene& scene, int map) {
    return map < 0 ? "none" : scene.textures.at(map).name;
}

TEST(MaterialMaps, OfMtlFiles) {
    const TempFolder folder;
    for (const char* name : {"color.ppm", "normal.ppm", "rough.ppm", "metal.ppm", "glow.ppm"}) {
        static_cast<void>(folder.write(name, picture("\x10\x20\x30")));
    }
    static_cast<void>(folder.write("room.mtl",
                                   "newmtl full\nKd 1 1 1\nmap_Kd color.ppm\nnorm normal.ppm\n"
                                   "map_Pr rough.ppm\nmap_Pm metal.ppm\nmap_Ke glow.ppm\n"
                                   "newmtl bare\nKd 1 1 1\nKe 1 1 1\nmap_Bump normal.ppm\n"));
    ObjWriter obj;
    obj.room({4, 3, 2.6}, true);
    obj.object("table").material("full").box({1, 1, 0}, {2, 2, 0.7});
    obj.object("chair").material("bare").box({3, 1, 0}, {3.4, 1.4, 0.9});
    const Scene scene = imported(folder.write("room.obj", "mtllib room.mtl\n" + obj.text()));
    const Material& full = materialOf(scene, "table");
    EXPECT_EQ(nameOf(scene, full.texture), "color.ppm");
    EXPECT_EQ(nameOf(scene, full.normal_map), "normal.ppm");
    EXPECT_EQ(nameOf(scene, full.roughness_map), "rough.ppm");
    EXPECT_EQ(nameOf(scene, full.metallic_map), "metal.ppm");
    EXPECT_EQ(nameOf(scene, full.emission_map), "glow.ppm");
    EXPECT_EQ(full.roughness, 1.0F);
    EXPECT_EQ(full.metallic, 1.0F);
    EXPECT_EQ(full.emission, Eigen::Vector3f(Eigen::Vector3f::Ones()));
    // Height maps are not normal maps, and Ke without a texture is more often a default than a
    // lamp.
    const Material& bare = materialOf(scene, "chair");
    EXPECT_FALSE(bare.hasMaps());
    EXPECT_TRUE(bare.emission.isZero(0.0F));
}

TEST(MaterialMaps, OfGltf) {
    const TempFolder folder;
    for (const char* name : {"normal.ppm", "surface.ppm", "glow.ppm"}) {
        static_cast<void>(folder.write(name, picture("\x10\x20\x30")));
    }
    // Positions and texture coordinates of a triangle of 1.5 m2.
    const float numbers[15] = {0, 0, 0, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
    std::string bytes(sizeof(numbers), '\0');
    std::memcpy(bytes.data(), numbers, sizeof(numbers));
    static_cast<void>(folder.write("room.bin", bytes));
    const auto file = folder.write("room.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
      "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "table"}],
      "buffers": [{"uri": "room.bin", "byteLength": 60}],
      "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                      {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                     "min": [0, 0, 0], "max": [3, 1, 0]},
                    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1},
                                  "material": 0}]}],
      "images": [{"uri": "normal.ppm"}, {"uri": "surface.ppm"}, {"uri": "glow.ppm"}],
      "textures": [{"source": 0}, {"source": 1}, {"source": 2}],
      "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0.5, "roughnessFactor": 0.25,
                                              "metallicRoughnessTexture": {"index": 1}},
                     "normalTexture": {"index": 0, "scale": 0.75},
                     "emissiveTexture": {"index": 2}, "emissiveFactor": [1, 0.5, 0]}]})");
    const Scene scene = imported(file);
    const Material& material = materialOf(scene, "table");
    EXPECT_EQ(nameOf(scene, material.normal_map), "normal.ppm");
    EXPECT_EQ(nameOf(scene, material.roughness_map), "surface.ppm");
    EXPECT_EQ(material.metallic_map, material.roughness_map);
    EXPECT_EQ(nameOf(scene, material.emission_map), "glow.ppm");
    EXPECT_EQ(material.texture, -1);
    EXPECT_EQ(material.normal_scale, 0.75F);
    EXPECT_EQ(material.metallic, 0.5F);
    EXPECT_EQ(material.roughness, 0.25F);
    EXPECT_EQ(material.emission, Eigen::Vector3f(1.0F, 0.5F, 0.0F));
}

}  // namespace
}  // namespace dollytrack::material_maps_test
