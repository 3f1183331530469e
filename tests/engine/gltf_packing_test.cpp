// Positions that are quantized, or compressed by meshoptimizer or Draco.

#include "tests/engine/gltf_sheet.h"

#include <draco/attributes/geometry_attribute.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstring>

namespace dollytrack::test::gltf::gltf_packing_test {
namespace {

using nlohmann::json;

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
        EXPECT_EQ(raw.nodes.at(part.node).name, "sheet");
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

}  // namespace
}  // namespace dollytrack::test::gltf::gltf_packing_test
