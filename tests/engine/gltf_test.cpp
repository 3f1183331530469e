// glTF in all encodings, compared with known numbers: a curved sheet with heights z = x y, as plain
// floats and in each compression.

#include "engine/io/import/model_reader.h"
#include "engine/io/import/scene_import.h"
#include "tests/support/glb_writer.h"
#include "tests/support/imported_scene.h"
#include "tests/support/temp_folder.h"

#include <draco/attributes/geometry_attribute.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>

namespace dollytrack {
namespace {

using nlohmann::json;
using test::GlbWriter;
using test::TempFolder;

constexpr int kByte = 5120;
constexpr int kUnsignedByte = 5121;
constexpr int kShort = 5122;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

constexpr std::size_t kSide = 20;  // vertices along a side of the sheet
constexpr std::size_t kCount = kSide * kSide;

/// A vertex of the sheet: x and y from 0 to 1, z = x y.
Eigen::Vector3f vertex(std::size_t i) {
    const float x = static_cast<float>(i % kSide) / (kSide - 1);
    const float y = static_cast<float>(i / kSide) / (kSide - 1);
    return {x, y, x * y};
}

std::vector<Eigen::Vector3f> vertices() {
    std::vector<Eigen::Vector3f> all;
    for (std::size_t i = 0; i < kCount; ++i) all.push_back(vertex(i));
    return all;
}

template <class Index>
std::vector<Index> triangles() {
    std::vector<Index> all;
    for (std::size_t y = 0; y + 1 < kSide; ++y) {
        for (std::size_t x = 0; x + 1 < kSide; ++x) {
            const std::size_t a = y * kSide + x;
            for (const std::size_t v : {a, a + 1, a + kSide, a + 1, a + kSide + 1, a + kSide}) {
                all.push_back(static_cast<Index>(v));
            }
        }
    }
    return all;
}

RawScene read(const std::string& bytes, const std::string& name = "sheet.glb") {
    const TempFolder folder;
    Result<RawScene> raw = readModel(folder.write(name, bytes), {});
    EXPECT_TRUE(raw) << raw.error().message;
    return raw ? std::move(*raw) : RawScene();
}

std::string refusalOf(const std::string& bytes, const std::string& name = "sheet.glb") {
    const TempFolder folder;
    const Result<RawScene> raw = readModel(folder.write(name, bytes), {});
    EXPECT_FALSE(raw);
    if (raw) return {};
    EXPECT_EQ(raw.error().code, ErrorCode::BadInput);
    EXPECT_TRUE(raw.error().where.ends_with("/" + name)) << raw.error().where;
    return raw.error().message;
}

/// Expects the complete sheet: its number of triangles, each corner on z = x y within `tolerance`,
/// x and y from 0 to 1. `place`: inverse of the test's transform of the sheet.
void expectSheet(const MeshPart& part, float tolerance,
                 const std::function<Eigen::Vector3f(Eigen::Vector3f)>& place = nullptr) {
    EXPECT_EQ(part.triangles.size(), 2 * (kSide - 1) * (kSide - 1));
    Eigen::AlignedBox3f box;
    double area = 0.0;
    for (const Triangle& t : part.triangles) {
        std::array<Eigen::Vector3f, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) {
            corners[c] = part.positions[t[c]];
            if (place) corners[c] = place(corners[c]);
            box.extend(corners[c]);
            ASSERT_NEAR(corners[c].z(), corners[c].x() * corners[c].y(), 3 * tolerance);
        }
        const Eigen::Vector3f cross = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        ASSERT_GT(cross.z(), 0.0F);
        area += 0.5 * static_cast<double>(cross.z());
    }
    EXPECT_NEAR(area, 1.0, 10 * tolerance);  // seen from above
    EXPECT_NEAR(box.min().minCoeff(), 0.0F, tolerance);
    EXPECT_NEAR(box.max().maxCoeff(), 1.0F, tolerance);
}

/// The sheet as floats and 16-bit indices.
GlbWriter plainSheet() {
    GlbWriter file;
    const std::size_t at = file.addAccessor(file.addView(vertices()), kFloat, "VEC3", kCount);
    const auto indices = triangles<std::uint16_t>();
    const std::size_t order =
        file.addAccessor(file.addView(indices), kUnsignedShort, "SCALAR", indices.size());
    file.addMesh("sheet", {{"attributes", {{"POSITION", at}}}, {"indices", order}});
    return file;
}

TEST(Gltf, PlainSheetFromBothContainers) {
    const GlbWriter file = plainSheet();
    for (const RawScene& raw : {read(file.glb()), read(file.gltf(), "sheet.gltf")}) {
        ASSERT_EQ(raw.parts.size(), 1U);
        expectSheet(raw.parts[0], 1e-6F);
        EXPECT_EQ(raw.nodes.at(static_cast<std::size_t>(raw.parts[0].node)).name, "sheet");
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

/// Positions as integers, and a nameless node that undoes their scaling.
template <class Integer>
GlbWriter quantizedSheet(int component_type, bool normalized, float steps) {
    GlbWriter file;
    std::vector<Integer> packed;
    for (const Eigen::Vector3f& at : vertices()) {
        for (const float x : {at.x(), at.y(), at.z(), 0.0F}) {
            packed.push_back(static_cast<Integer>(std::lround((2.0F * x - 1.0F) * steps)));
        }
    }
    const std::size_t at = file.addAccessor(file.addView(packed, 4 * sizeof(Integer)),
                                            component_type, "VEC3", kCount, normalized);
    const auto indices = triangles<std::uint16_t>();
    const std::size_t order =
        file.addAccessor(file.addView(indices), kUnsignedShort, "SCALAR", indices.size());
    file.addMesh("", {{"attributes", {{"POSITION", at}}}, {"indices", order}});
    const float half = normalized ? 0.5F : 0.5F / steps;
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    file.json["nodes"] = {
        {{"name", "sheet"}, {"children", {1}}},
        {{"mesh", 0}, {"scale", {half, half, half}}, {"translation", {0.5, 0.5, 0.5}}}};
    return file;
}

TEST(Gltf, QuantizedPositions) {
    for (const RawScene& raw : {read(quantizedSheet<std::int16_t>(kShort, true, 32767.0F).glb()),
                                read(quantizedSheet<std::int16_t>(kShort, false, 5000.0F).glb()),
                                read(quantizedSheet<std::int8_t>(kByte, true, 127.0F).glb())}) {
        ASSERT_EQ(raw.parts.size(), 1U);
        const MeshPart& part = raw.parts[0];
        expectSheet(part, 4e-3F);
        // The quantizer's node is not an object.
        EXPECT_EQ(raw.nodes.at(static_cast<std::size_t>(part.node)).name, "sheet");
    }
    expectSheet(read(quantizedSheet<std::int16_t>(kShort, true, 32767.0F).glb()).parts[0], 4e-5F);
    expectSheet(read(quantizedSheet<std::int16_t>(kShort, false, 5000.0F).glb()).parts[0], 2e-4F);
}

std::string meshoptVertices(const void* data, std::size_t stride) {
    std::string packed(meshopt_encodeVertexBufferBound(kCount, stride), '\0');
    packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
                                             packed.size(), data, kCount, stride));
    return packed;
}

/// Adds a compressed buffer view, with a fallback buffer that is not read.
std::size_t addPacked(GlbWriter& file, const std::string& packed, std::size_t count,
                      std::size_t stride, const char* mode, const char* filter = "NONE") {
    const std::size_t index = file.addView(packed);
    json& view = file.json["bufferViews"][index];
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", view["byteOffset"]},
                                                     {"byteLength", packed.size()},
                                                     {"count", count},
                                                     {"byteStride", stride},
                                                     {"mode", mode},
                                                     {"filter", filter}};
    view["buffer"] = 1;
    view["byteOffset"] = 0;
    view["byteLength"] = count * stride;
    if (std::strcmp(mode, "ATTRIBUTES") == 0) view["byteStride"] = stride;
    return index;
}

GlbWriter meshoptSheet(const char* index_mode) {
    GlbWriter file;
    const auto points = vertices();
    const auto order = triangles<unsigned>();
    std::string indices(std::string(index_mode) == "TRIANGLES"
                            ? meshopt_encodeIndexBufferBound(order.size(), kCount)
                            : meshopt_encodeIndexSequenceBound(order.size(), kCount),
                        '\0');
    auto* into = reinterpret_cast<unsigned char*>(indices.data());
    indices.resize(
        std::string(index_mode) == "TRIANGLES"
            ? meshopt_encodeIndexBuffer(into, indices.size(), order.data(), order.size())
            : meshopt_encodeIndexSequence(into, indices.size(), order.data(), order.size()));
    const std::size_t at = file.addAccessor(
        addPacked(file, meshoptVertices(points.data(), 12), kCount, 12, "ATTRIBUTES"), kFloat,
        "VEC3", kCount);
    const std::size_t faces =
        file.addAccessor(addPacked(file, indices, order.size(), 2, index_mode), kUnsignedShort,
                         "SCALAR", order.size());
    file.addMesh("sheet", {{"attributes", {{"POSITION", at}}}, {"indices", faces}});
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    file.json["buffers"] = {{{"byteLength", file.buffer().size()}},
                            {{"byteLength", 100'000},
                             {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return file;
}

TEST(Gltf, MeshoptModes) {
    expectSheet(read(meshoptSheet("TRIANGLES").glb()).parts.at(0), 1e-6F);
    expectSheet(read(meshoptSheet("INDICES").glb()).parts.at(0), 1e-6F);
}

// Filters as defined by EXT_meshopt_compression, decoded here independently.
TEST(Gltf, MeshoptFilters) {
    GlbWriter file = meshoptSheet("TRIANGLES");
    std::vector<std::int32_t> exponential;
    for (const Eigen::Vector3f& at : vertices()) {
        for (const float x : at) {  // value = mantissa 2^exponent, exponent in the top byte
            exponential.push_back(static_cast<std::int32_t>(std::lround(std::ldexp(x, 20))) |
                                  static_cast<std::int32_t>(0xECU << 24U));
        }
    }
    std::vector<std::int8_t> octahedral;
    for (std::size_t i = 0; i < kCount; ++i) {  // (0.6, 0, 0.8): x / (x + z) of 127, 0, 127
        octahedral.insert(octahedral.end(), {54, 0, 127, 0});
    }
    const std::size_t at = file.addAccessor(addPacked(file, meshoptVertices(exponential.data(), 12),
                                                      kCount, 12, "ATTRIBUTES", "EXPONENTIAL"),
                                            kFloat, "VEC3", kCount);
    const std::size_t normal =
        file.addAccessor(addPacked(file, meshoptVertices(octahedral.data(), 4), kCount, 4,
                                   "ATTRIBUTES", "OCTAHEDRAL"),
                         kByte, "VEC3", kCount, true);
    file.json["buffers"][0]["byteLength"] = file.buffer().size();
    json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes = {{"POSITION", at}, {"NORMAL", normal}};
    const RawScene raw = read(file.glb());
    expectSheet(raw.parts.at(0), 2e-6F);
    for (const Eigen::Vector3f& n : raw.parts[0].normals) {
        ASSERT_NEAR((n - Eigen::Vector3f(0.6F, 0.0F, 0.8F)).norm(), 0.0F, 0.02F);
    }
}

std::string dracoBytes(int quantization_bits) {
    draco::TriangleSoupMeshBuilder builder;
    const auto order = triangles<std::uint32_t>();
    builder.Start(static_cast<int>(order.size() / 3));
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::size_t f = 0; f < order.size() / 3; ++f) {
        std::array<Eigen::Vector3f, 3> c = {vertex(order[3 * f]), vertex(order[3 * f + 1]),
                                            vertex(order[3 * f + 2])};
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<unsigned>(f)),
                                          c[0].data(), c[1].data(), c[2].data());
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    if (quantization_bits > 0) {
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, quantization_bits);
    }
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

/// As written by exporters: accessors without data, 32-bit indices.
GlbWriter dracoSheet(const std::string& bytes) {
    GlbWriter file;
    const std::size_t view = file.addView(bytes);
    file.json["accessors"] = {{{"componentType", kFloat}, {"type", "VEC3"}, {"count", kCount}},
                              {{"componentType", kUnsignedInt},
                               {"type", "SCALAR"},
                               {"count", triangles<std::uint32_t>().size()}}};
    file.addMesh("sheet", {{"attributes", {{"POSITION", 0}}},
                           {"indices", 1},
                           {"extensions",
                            {{"KHR_draco_mesh_compression",
                              {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}}});
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return file;
}

TEST(Gltf, DracoWith32BitIndices) {
    expectSheet(read(dracoSheet(dracoBytes(0)).glb()).parts.at(0), 1e-6F);
    expectSheet(read(dracoSheet(dracoBytes(14)).glb()).parts.at(0), 1e-4F);
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
        const SourceNode& node = raw.nodes.at(static_cast<std::size_t>(raw.parts[i].node));
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
TEST(Gltf, DamagedPackings) {
    const std::string draco = dracoBytes(14);
    for (const std::size_t length :
         {std::size_t{1}, std::size_t{5}, draco.size() / 2, draco.size() - 8}) {
        EXPECT_NE(refusalOf(dracoSheet(draco.substr(0, length)).glb()).find("Draco"),
                  std::string::npos)
            << length;
    }
    GlbWriter other = dracoSheet(draco);
    json& packed =
        other.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
    packed["attributes"]["POSITION"] = 9;
    EXPECT_NE(refusalOf(other.glb()).find("lacks the attribute POSITION"), std::string::npos);

    const auto changed = [](const char* key, const json& value) {
        GlbWriter file = meshoptSheet("TRIANGLES");
        file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
        return refusalOf(file.glb());
    };
    for (const std::size_t count : {std::size_t{100'000'000}, std::size_t{1} << 62U}) {
        EXPECT_NE(changed("count", count).find("more data than its bytes can contain"),
                  std::string::npos);
    }
    EXPECT_NE(changed("byteLength", 20).find("more data than its bytes can contain"),
              std::string::npos);
    EXPECT_NE(changed("byteLength", 200).find("is damaged"), std::string::npos);
    EXPECT_NE(changed("byteStride", 10).find("is damaged"), std::string::npos);
    EXPECT_NE(changed("byteStride", 0).find("more data than its bytes"), std::string::npos);
    EXPECT_NE(changed("mode", "OTHER").find("is damaged"), std::string::npos);
    EXPECT_NE(changed("filter", "OTHER").find("is damaged"), std::string::npos);
    EXPECT_NE(changed("filter", "QUATERNION").find("is damaged"), std::string::npos);
    EXPECT_NE(changed("buffer", 1).find("has no data"), std::string::npos);
}

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
}  // namespace dollytrack
