// glTF in all containers, compared with known numbers.

#include "tests/engine/gltf_sheet.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace dollytrack::test::gltf::gltf_test {
namespace {

using nlohmann::json;

TEST(Gltf, PlainSheetFromBothContainers) {
    const GlbWriter file = plainSheet();
    for (const RawScene& raw : {read(file.glb()), read(file.gltf(), "sheet.gltf")}) {
        ASSERT_EQ(raw.parts.size(), 1U);
        expectSheet(raw.parts[0], 1e-6F);
        EXPECT_EQ(raw.nodes.at(raw.parts[0].node).name, "sheet");
        EXPECT_EQ(raw.file_unit_m, 1.0);
        EXPECT_EQ(raw.file_up_axis.letter, 'y');
    }
}

// The specification requires stride * (count - 1) + element bytes, not stride * count.
TEST(Gltf, InterleavedViewThatEndsWithItsLastElement) {
    GlbWriter file;
    constexpr std::size_t kStride = 20;
    std::string bytes((kCount - 1) * kStride + sizeof(Eigen::Vector3f), '\x7F');
    for (std::size_t i = 0; i < kCount; ++i) {
        const Eigen::Vector3f at = vertex(i);
        std::memcpy(bytes.data() + i * kStride, at.data(), sizeof(at));
    }
    const std::size_t at = file.addAccessor(file.addView(bytes, kStride), kFloat, "VEC3", kCount);
    const auto indices = triangles<std::uint32_t>();
    const std::size_t order =
        file.addAccessor(file.addView(indices), kUnsignedInt, "SCALAR", indices.size());
    file.addMesh("sheet", {{"attributes", {{"POSITION", at}}}, {"indices", order}});
    expectSheet(read(file.glb()).parts.at(0), 1e-6F);
    file.json["bufferViews"][0]["byteLength"] = bytes.size() - 1;
    EXPECT_NE(refusalOf(file.glb()).find("400 elements reach beyond bufferViews[0]"),
              std::string::npos);
}

TEST(Gltf, MeshesWithSkeletonsAreReported) {
    GlbWriter file = plainSheet();
    EXPECT_TRUE(read(file.glb()).warnings.empty());
    file.json["nodes"][0]["skin"] = 0;
    const RawScene raw = read(file.glb());
    ASSERT_EQ(raw.warnings.size(), 1U);
    EXPECT_NE(raw.warnings[0].find("1 mesh is deformed by a skeleton"), std::string::npos);
}

TEST(Gltf, EachInstanceIsANodeOfItsOwn) {
    GlbWriter file = plainSheet();
    const std::vector<float> places = {1, 2, 3, -4, 5, -6, 0, 0, 7};
    const float half = std::sqrt(0.5F);
    const std::vector<float> turns = {0, 0, 0, 1, 0, 0, half, half, 0, 0, 0, 1};  // 90 deg about z
    const std::vector<float> scales = {1, 1, 1, 2, 2, 2, 1, 1, 0.5F};
    const std::size_t place = file.addAccessor(file.addView(places), kFloat, "VEC3", 3);
    const std::size_t turn = file.addAccessor(file.addView(turns), kFloat, "VEC4", 3);
    const std::size_t scale = file.addAccessor(file.addView(scales), kFloat, "VEC3", 3);
    file.json["nodes"][0]["translation"] = {10, 0, 0};
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", place}, {"ROTATION", turn}, {"SCALE", scale}};
    file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const RawScene raw = read(file.glb());
    ASSERT_EQ(raw.parts.size(), 3U);
    expectSheet(raw.parts[0], 1e-5F,
                [](Eigen::Vector3f p) -> Eigen::Vector3f { return p - Eigen::Vector3f(11, 2, 3); });
    expectSheet(raw.parts[1], 1e-5F, [](Eigen::Vector3f p) -> Eigen::Vector3f {
        p = (p - Eigen::Vector3f(6, 5, -6)) / 2.0F;
        return {p.y(), -p.x(), p.z()};
    });
    expectSheet(raw.parts[2], 1e-5F, [](Eigen::Vector3f p) -> Eigen::Vector3f {
        p -= Eigen::Vector3f(10, 0, 7);
        return {p.x(), p.y(), 2.0F * p.z()};
    });
    for (std::size_t i = 0; i < 3; ++i) {
        const SourceNode& node = raw.nodes.at(raw.parts[i].node);
        EXPECT_EQ(node.name, "sheet_" + std::to_string(i + 1));
    }
    file.json["accessors"][turn]["count"] = 2;
    EXPECT_NE(refusalOf(file.glb()).find("ROTATION has another number of elements"),
              std::string::npos);
}

TEST(Gltf, SparseAccessorsReplaceElements) {
    GlbWriter file = plainSheet();
    std::vector<Eigen::Vector3f> wrong = vertices();
    wrong[7].setConstant(100.0F);
    const std::size_t base = file.addView(wrong);
    const std::size_t which = file.addView(std::vector<std::uint16_t>{7});
    const std::size_t what = file.addView(std::vector<Eigen::Vector3f>{vertex(7)});
    file.json["accessors"][0]["bufferView"] = base;
    file.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", which}, {"componentType", kUnsignedShort}}},
        {"values", {{"bufferView", what}}}};
    expectSheet(read(file.glb()).parts.at(0), 1e-6F);
    file.json["accessors"][0]["count"] = 7;  // the seventh element does not exist
    EXPECT_NE(refusalOf(file.glb()).find("sparse"), std::string::npos);
}

TEST(Gltf, StripsAndFansFaceOneWay) {
    GlbWriter file;
    const std::vector<Eigen::Vector3f> strip = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    const std::vector<Eigen::Vector3f> fan = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::size_t first = file.addAccessor(file.addView(strip), kFloat, "VEC3", 4);
    const std::size_t second = file.addAccessor(file.addView(fan), kFloat, "VEC3", 4);
    file.addMesh("strip", {{"attributes", {{"POSITION", first}}}, {"mode", 5}});
    file.addMesh("fan", {{"attributes", {{"POSITION", second}}}, {"mode", 6}});
    file.addMesh("lines", {{"attributes", {{"POSITION", second}}}, {"mode", 3}});
    const RawScene raw = read(file.glb());
    ASSERT_EQ(raw.parts.size(), 3U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(raw.parts[i].triangles.size(), 2U);
        EXPECT_NEAR(raw.parts[i].facing_area[5], 1.0, 1e-6);  // all of it faces +z
    }
    EXPECT_TRUE(raw.parts[2].triangles.empty());
    EXPECT_EQ(raw.repairs.lines, 3U);
}

/// A sheet with texture coordinates (x, y) and a material with one texture.
GlbWriter texturedSheet(int component_type, bool normalized) {
    GlbWriter file = plainSheet();
    std::vector<float> floats;
    std::vector<std::uint16_t> shorts;
    for (const Eigen::Vector3f& at : vertices()) {
        floats.insert(floats.end(), {at.x(), at.y()});
        for (const float x : {at.x(), at.y()}) {
            shorts.push_back(static_cast<std::uint16_t>(std::lround(x * 65535.0F)));
        }
    }
    const std::size_t view = component_type == kFloat ? file.addView(floats) : file.addView(shorts);
    const std::size_t uv = file.addAccessor(view, component_type, "VEC2", kCount, normalized);
    json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = uv;
    primitive["material"] = 0;
    file.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.25, 0.125, 1.0}}, {"baseColorTexture", {{"index", 0}}}}}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["images"] = {{{"uri", "oak%20wood.png"}}};
    return file;
}

// KHR_texture_transform with the rotation of Blender's importer: (x, y), y downwards, becomes
// offset + (sx x cos + sy y sin, sy y cos - sx x sin).
TEST(Gltf, PictureCoordinatesAreTransformed) {
    GlbWriter file = texturedSheet(kUnsignedShort, true);
    json& info = file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.25, 0.5}}, {"rotation", 0.5}, {"scale", {2, 3}}};
    const RawScene raw = read(file.glb());
    const MeshPart& part = raw.parts.at(0);
    const float c = std::cos(0.5F);
    const float s = std::sin(0.5F);
    for (std::size_t i = 0; i < part.positions.size(); ++i) {
        const float x = part.positions[i].x();
        const float y = part.positions[i].y();
        const Eigen::Vector2f at(0.25F + 2 * x * c + 3 * y * s, 0.5F + 3 * y * c - 2 * x * s);
        ASSERT_NEAR(part.uvs[i].x(), at.x(), 1e-4F);
        ASSERT_NEAR(part.uvs[i].y(), 1.0F - at.y(), 1e-4F);  // the engine's v points upwards
    }
    EXPECT_EQ(raw.textures.at(0).name, "oak%20wood.png");
}

TEST(Gltf, SourcesOfTexturesInExtensions) {
    const TempFolder folder;
    const cv::Mat picture(4, 4, CV_8UC3, cv::Scalar(10, 20, 200));
    std::vector<std::uint8_t> webp;
    ASSERT_TRUE(cv::imencode(".webp", picture, webp));
    GlbWriter file = texturedSheet(kFloat, false);
    const std::size_t view = file.addView(webp);
    file.json["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
    file.json["images"][0] = {{"bufferView", view}, {"mimeType", "image/webp"}};
    file.json["extensionsRequired"] = {"EXT_texture_webp"};
    const Scene scene = test::imported(folder.write("room.glb", file.glb()));
    EXPECT_EQ(scene.report.textures_found, 1);
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].width, 4);
    EXPECT_NEAR(scene.textures[0].rgba[0], 200, 8);

    // The same with KTX2: geometry with a flat colour, and one warning.
    file.json["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    file.json["images"][0] = {{"uri", "oak.ktx2"}};
    file.json["extensionsRequired"] = {"KHR_texture_basisu"};
    const RawScene flat = read(file.glb());
    EXPECT_EQ(flat.materials.at(0).texture, -1);
    EXPECT_EQ(flat.materials[0].base_color, Eigen::Vector3f(0.5F, 0.25F, 0.125F));
    EXPECT_TRUE(flat.textures.empty());
    ASSERT_EQ(flat.warnings.size(), 1U);
    EXPECT_NE(flat.warnings[0].find("1 texture is KTX2"), std::string::npos);
    expectSheet(flat.parts.at(0), 1e-6F);
}

TEST(Gltf, ExtensionsOfMaterials) {
    GlbWriter file = texturedSheet(kFloat, false);
    const auto material = [&](const json& extensions) {
        json& written = file.json["materials"][0];
        written["emissiveFactor"] = {1.0, 0.5, 0.25};
        written["extensions"] = extensions;
        return read(file.glb()).materials.at(0);
    };
    EXPECT_EQ(material(json::object()).emission, Eigen::Vector3f(1.0F, 0.5F, 0.25F));
    EXPECT_EQ(material({{"KHR_materials_emissive_strength", {{"emissiveStrength", 4.0}}}}).emission,
              Eigen::Vector3f(4.0F, 2.0F, 1.0F));
    EXPECT_EQ(
        material({{"KHR_materials_emissive_strength", {{"emissiveStrength", -1.0}}}}).emission,
        Eigen::Vector3f(0.0F, 0.0F, 0.0F));
    EXPECT_EQ(material(json::object()).opacity, 1.0F);
    EXPECT_EQ(material({{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}}}).opacity,
              0.25F);
    EXPECT_EQ(material({{"KHR_materials_transmission", json::object()}}).opacity, 1.0F);
    const Material unlit = material({{"KHR_materials_unlit", json::object()}});
    EXPECT_EQ(unlit.metallic, 0.0F);
    EXPECT_EQ(unlit.roughness, 1.0F);
}

TEST(Gltf, ABlackFactorDoesNotHideTheTexture) {
    GlbWriter file = texturedSheet(kFloat, false);
    json& color = file.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
    color = {0, 0, 0, 1};
    const RawScene black = read(file.glb());
    EXPECT_EQ(black.materials.at(0).base_color, Eigen::Vector3f(1.0F, 1.0F, 1.0F));
    ASSERT_EQ(black.warnings.size(), 1U);
    EXPECT_NE(black.warnings[0].find("1 material multiplies its texture by black"),
              std::string::npos);
    color = {0.1, 0, 0, 1};
    const RawScene dark = read(file.glb());
    EXPECT_EQ(dark.materials.at(0).base_color, Eigen::Vector3f(0.1F, 0.0F, 0.0F));
    EXPECT_TRUE(dark.warnings.empty());
}

// Vertex colours are linear in glTF and multiply the base colour.
TEST(Gltf, ColoursOfVerticesMultiply) {
    GlbWriter file = texturedSheet(kFloat, false);
    const std::vector<std::uint8_t> colors(4 * kCount, 51);  // a fifth
    const std::size_t color =
        file.addAccessor(file.addView(colors), kUnsignedByte, "VEC4", kCount, true);
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = color;
    file.json["materials"][0]["pbrMetallicRoughness"].erase("baseColorTexture");
    const RawScene raw = read(file.glb());
    const Material& material = raw.materials.at(raw.parts.at(0).material);
    EXPECT_TRUE(material.base_color.isApprox(Eigen::Vector3f(0.1F, 0.05F, 0.025F), 1e-4F));
}

TEST(Gltf, ExtensionsThatAreRequiredAndUnknownAreNamed) {
    GlbWriter file = plainSheet();
    file.json["extensionsRequired"] = {"KHR_mesh_quantization", "ACME_folded_space",
                                       "ACME_twisted_light"};
    const std::string message = refusalOf(file.glb());
    EXPECT_NE(message.find("ACME_folded_space, ACME_twisted_light"), std::string::npos) << message;
    EXPECT_EQ(message.find("KHR_mesh_quantization"), std::string::npos) << message;
    file.json["extensionsUsed"] = file.json["extensionsRequired"];
    file.json.erase("extensionsRequired");
    expectSheet(read(file.glb()).parts.at(0), 1e-6F);
}

TEST(Gltf, BuffersBesideTheFile) {
    const TempFolder folder;
    GlbWriter file = plainSheet();
    file.json["buffers"] = {{{"byteLength", file.buffer().size()}, {"uri", "a%20sheet.bin"}}};
    const auto path = folder.write("sheet.gltf", file.json.dump());
    const Result<RawScene> without = readModel(path, {});
    ASSERT_FALSE(without);
    EXPECT_NE(without.error().message.find("a%20sheet.bin"), std::string::npos);
    EXPECT_NE(without.error().message.find("put it beside the file"), std::string::npos);
    static_cast<void>(folder.write("a sheet.bin", file.buffer()));
    const Result<RawScene> with = readModel(path, {});
    ASSERT_TRUE(with) << with.error().message;
    expectSheet(with->parts.at(0), 1e-6F);
    // The error of a truncated buffer has its size.
    static_cast<void>(folder.write("a sheet.bin", file.buffer().substr(0, 100)));
    const Result<RawScene> cut = readModel(path, {});
    ASSERT_FALSE(cut);
    EXPECT_NE(cut.error().message.find("but has 100"), std::string::npos);
}

TEST(Gltf, NodesThatMakeNoTree) {
    GlbWriter file = plainSheet();
    file.json["nodes"][0]["children"] = {0};
    EXPECT_NE(refusalOf(file.glb()).find("nodes[0] occurs twice in the scene"), std::string::npos);
    file.json["nodes"][0]["children"] = {5};
    EXPECT_NE(refusalOf(file.glb()).find("nodes[5] is missing"), std::string::npos);
    file.json["nodes"][0].erase("children");
    file.json["scenes"][0]["nodes"] = json::array();
    EXPECT_NE(refusalOf(file.glb()).find("no node of its scene has a mesh"), std::string::npos);
    // Without scenes, all nodes that are not children are roots.
    file.json.erase("scenes");
    expectSheet(read(file.glb()).parts.at(0), 1e-6F);
}

TEST(Gltf, OtherVersionsAreNamed) {
    GlbWriter file = plainSheet();
    file.json["asset"]["version"] = "1.0";
    EXPECT_NE(refusalOf(file.gltf(), "old.gltf").find("glTF 1.0; export it as glTF 2.0"),
              std::string::npos);
}

// Damaged bytes give one sentence with any decoder, and never need more memory than the file
// justifies.
TEST(Gltf, CountsThatLie) {
    const auto changed = [](const char* key, const json& value) {
        GlbWriter file = plainSheet();
        file.json["accessors"][0][key] = value;
        return refusalOf(file.glb());
    };
    for (const json& count : {json(401), json(4294967295U), json(1ULL << 63U)}) {
        EXPECT_NE(changed("count", count).find("reach beyond"), std::string::npos) << count;
    }
    for (const json& count : {json(-1), json(0.5), json(1e300), json("8"), json(json::array())}) {
        EXPECT_NE(changed("count", count).find("not a whole number"), std::string::npos) << count;
    }
    EXPECT_NE(changed("byteOffset", 1ULL << 63U).find("reach beyond"), std::string::npos);
    EXPECT_NE(changed("bufferView", 99).find("bufferViews[99] is missing"), std::string::npos);
    EXPECT_NE(changed("componentType", 5124).find("5124 is not a component type"),
              std::string::npos);
    EXPECT_NE(changed("type", "MAT4").find("neither SCALAR nor VEC2"), std::string::npos);
    EXPECT_NE(changed("type", "VEC2").find("POSITION has too few components"), std::string::npos);
    GlbWriter empty = plainSheet();
    empty.json["accessors"][0].erase("bufferView");
    EXPECT_NE(refusalOf(empty.glb()).find("accessors[0] has no data"), std::string::npos);
}

// A .glb truncated at any position is refused with a sentence.
TEST(Gltf, CutOffAnywhere) {
    const std::string whole = plainSheet().glb();
    for (std::size_t length = 4; length + 8 < whole.size(); length += 97) {
        EXPECT_GT(refusalOf(whole.substr(0, length)).size(), 10U) << length;
    }
}

}  // namespace
}  // namespace dollytrack::test::gltf::gltf_test
