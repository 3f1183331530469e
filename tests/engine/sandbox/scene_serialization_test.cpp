#include "engine/io/sandbox/scene_serialization.h"
#include "engine/core/clean_text.h"
#include "engine/io/sandbox/binary_archive.h"
#include "tests/engine/sandbox/serialized_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace dollytrack::scene_serialization_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kHeaderBytes = 32;

/// The invariants of a scene, checked independently of the code under test.
void expectSound(const DecodedScene& scene) {
    const RawScene& raw = scene.raw;
    for (std::size_t i = 0; i < raw.nodes.size(); ++i) {
        ASSERT_LT(raw.nodes[i].parent, static_cast<int>(i));
        ASSERT_GE(raw.nodes[i].parent, -1);
        ASSERT_EQ(cleanText(raw.nodes[i].name), raw.nodes[i].name);
    }
    for (const MeshPart& part : raw.parts) {
        ASSERT_LT(static_cast<std::size_t>(part.node), raw.nodes.size());
        ASSERT_LT(part.material, raw.materials.size());
        ASSERT_EQ(part.normals.size(), part.positions.size());
        ASSERT_EQ(part.uvs.size(), part.positions.size());
        for (const Triangle& triangle : part.triangles) {
            for (const std::uint32_t corner : triangle) ASSERT_LT(corner, part.positions.size());
        }
        for (std::size_t v = 0; v < part.positions.size(); ++v) {
            ASSERT_TRUE(part.positions[v].allFinite() && part.normals[v].allFinite() &&
                        part.uvs[v].allFinite());
            ASSERT_TRUE(part.bounds.contains(part.positions[v]));
        }
        ASSERT_TRUE(std::isfinite(part.area));
    }
    for (const Material& material : raw.materials) {
        for (const int map : {material.texture, material.normal_map, material.roughness_map,
                              material.metallic_map, material.emission_map}) {
            ASSERT_TRUE(map >= -1 && map < static_cast<int>(raw.textures.size()));
        }
        ASSERT_TRUE(std::isfinite(material.normal_scale));
        ASSERT_TRUE(material.base_color.allFinite() && material.emission.allFinite());
    }
    for (const SourceObject& object : raw.objects) {
        for (const std::size_t part : object.parts) ASSERT_LT(part, raw.parts.size());
        ASSERT_TRUE(object.nyu40 >= 0 && object.nyu40 <= 40);
    }
    for (const Texture& texture : scene.textures.textures) {
        ASSERT_EQ(texture.rgba.size(), 4 * static_cast<std::size_t>(texture.width) *
                                           static_cast<std::size_t>(texture.height));
    }
    const double unit_m = raw.file_unit_m.value_or(1.0);
    ASSERT_TRUE(std::isfinite(unit_m) && unit_m > 0.0);
}

TEST(SceneSerialization, BringsEverythingBack) {
    const DecodedScene before = test::smallDecodedScene();
    const Bytes bytes = test::serialized(before);
    bool damaged = true;
    const Result<DecodedScene> after = deserializeScene(bytes, damaged);
    ASSERT_TRUE(after) << after.error().message;
    EXPECT_FALSE(damaged);
    expectSound(*after);
    ASSERT_EQ(after->raw.parts.size(), 2U);
    EXPECT_EQ(after->raw.parts[1].positions, before.raw.parts[1].positions);
    EXPECT_EQ(after->raw.parts[1].triangles, before.raw.parts[1].triangles);
    EXPECT_EQ(after->raw.parts[1].area, 2.0);
    EXPECT_EQ(after->raw.materials[1].normal_map, 1);
    EXPECT_EQ(after->raw.materials[1].normal_scale, 0.5F);
    EXPECT_EQ(after->raw.materials[1].metallic_map, 2);
    EXPECT_EQ(after->raw.objects[0].front, before.raw.objects[0].front);
    EXPECT_EQ(after->raw.file_unit_m, 0.01);
    EXPECT_EQ(after->raw.notes, before.raw.notes);
    EXPECT_EQ(after->textures.textures[0].rgba, before.textures.textures[0].rgba);
    EXPECT_EQ(after->textures.broken, before.textures.broken);
    // Written again, it is byte-identical.
    EXPECT_EQ(test::serialized(*after), bytes);
}

TEST(SceneSerialization, BringsErrorsBackCleaned) {
    const Bytes bytes = test::serialized(
        tl::unexpected(Error{ErrorCode::BadInput, "bad\x1b[31m\nfile", "room.obj"}));
    bool damaged = true;
    const Result<DecodedScene> error = deserializeScene(bytes, damaged);
    ASSERT_FALSE(error);
    EXPECT_FALSE(damaged);
    EXPECT_EQ(error.error().message, "bad[31mfile");
    // Error codes that the importer cannot know are not accepted.
    const Bytes other = test::serialized(tl::unexpected(Error{ErrorCode::CannotWrite, "x", ""}));
    EXPECT_EQ(deserializeScene(other, damaged).error().code, ErrorCode::BadInput);
}

// Each changed byte and each truncation is detected.
TEST(SceneSerialization, NoticesEveryByte) {
    const Bytes bytes = test::serialized(test::smallDecodedScene());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (const int change : {0x01, 0x80, 0xFF}) {
            Bytes other = bytes;
            other[i] ^= static_cast<std::uint8_t>(change);
            bool damaged = false;
            ASSERT_FALSE(deserializeScene(other, damaged)) << i;
            ASSERT_TRUE(damaged);
        }
        bool damaged = false;
        ASSERT_FALSE(deserializeScene(std::span(bytes).first(i), damaged)) << i;
    }
}

// With a corrected checksum, as a compromised importer could write: bytes that are accepted must
// contain valid scenes.
TEST(SceneSerialization, SealedMutantsAreRefusedOrSound) {
    const Bytes bytes = test::serialized(test::smallDecodedScene());
    std::mt19937 random(7);
    const std::array<std::uint64_t, 8> evil = {0,
                                               1,
                                               0x7FFFFFFF,
                                               0xFFFFFFFF,
                                               0x7FC00000,  // NaN as a float
                                               0x7F800000,  // infinity
                                               0x7FFFFFFFFFFFFFFF,
                                               0xFFFFFFFFFFFFFFFF};
    int refused = 0;
    int sound = 0;
    for (int mutant = 0; mutant < 20'000; ++mutant) {
        Bytes other = bytes;
        const int changes = 1 + static_cast<int>(random() % 3);
        for (int i = 0; i < changes; ++i) {
            const std::size_t width = std::array{1, 4, 8}[random() % 3];
            const std::size_t at = kHeaderBytes + random() % (other.size() - kHeaderBytes - width);
            std::uint64_t value = random() % 2 == 0 ? evil[random() % evil.size()] : random();
            std::memcpy(other.data() + at, &value, width);
        }
        updateChecksum(other);
        bool damaged = false;
        const Result<DecodedScene> read = deserializeScene(other, damaged);
        if (!read) {
            ++refused;
            ASSERT_TRUE(damaged);
            ASSERT_FALSE(read.error().message.empty());
            continue;
        }
        ++sound;
        expectSound(*read);
        if (HasFatalFailure()) FAIL() << "mutant " << mutant;
    }
    // Both results must occur, otherwise the test proves little.
    EXPECT_GT(refused, 1000);
    EXPECT_GT(sound, 1000);
}

TEST(SceneSerialization, CountsAreNotBelieved) {
    Bytes bytes = test::serialized(test::smallDecodedScene());
    // The first number after the header is the number of nodes.
    for (const std::uint64_t count :
         {std::uint64_t{4}, std::uint64_t{1} << 32U, std::numeric_limits<std::uint64_t>::max()}) {
        std::memcpy(bytes.data() + kHeaderBytes, &count, sizeof(count));
        updateChecksum(bytes);
        bool damaged = false;
        EXPECT_FALSE(deserializeScene(bytes, damaged)) << count;
        EXPECT_TRUE(damaged);
    }
}

TEST(SceneSerialization, EntriesLargerThanTheirBytesAreBounded) {
    const std::vector<std::string> texts(1000);  // of 8 bytes each
    const std::string written =
        listText(texts, [](auto& to, const std::string& text) { to.text(text); });
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(written.data()), written.size());
    for (const std::size_t allowed : {1000 * sizeof(std::string), 999 * sizeof(std::string)}) {
        BinaryReader reader(bytes, allowed);
        std::vector<std::string> read;
        reader.list(read, 8, [](auto& from, std::string& text) { from.text(text); });
        EXPECT_EQ(reader.finished(), allowed == 1000 * sizeof(std::string));
        EXPECT_EQ(read.size(), reader.good() ? 1000U : 0U);
    }
}

/// A defect that a compromised importer could put into a scene.
using Spoil = void (*)(DecodedScene&);

TEST(SceneSerialization, RefusesScenesThatAreNotSound) {
    const std::vector<std::pair<const char*, Spoil>> cases = {
        {"index", [](DecodedScene& s) { s.raw.parts[0].triangles[0][1] = 4; }},
        {"nan", [](DecodedScene& s) { s.raw.parts[0].positions[0].x() = NAN; }},
        {"beyond reach", [](DecodedScene& s) { s.raw.parts[0].positions[0].x() = 2e9F; }},
        {"infinite uv", [](DecodedScene& s) { s.raw.parts[0].uvs[0].y() = INFINITY; }},
        {"long normal", [](DecodedScene& s) { s.raw.parts[0].normals[0] *= 2.0F; }},
        {"fewer normals", [](DecodedScene& s) { s.raw.parts[0].normals.pop_back(); }},
        {"node", [](DecodedScene& s) { s.raw.parts[0].node = 3; }},
        {"negative node", [](DecodedScene& s) { s.raw.parts[0].node = -1; }},
        {"material", [](DecodedScene& s) { s.raw.parts[0].material = 2; }},
        {"parent", [](DecodedScene& s) { s.raw.nodes[1].parent = 1; }},
        {"texture", [](DecodedScene& s) { s.raw.materials[0].texture = 3; }},
        {"color", [](DecodedScene& s) { s.raw.materials[0].base_color.x() = 1.5F; }},
        {"opacity", [](DecodedScene& s) { s.raw.materials[0].opacity = NAN; }},
        {"object's part", [](DecodedScene& s) { s.raw.objects[0].parts[0] = 2; }},
        {"part taken twice", [](DecodedScene& s) { s.raw.objects[0].parts = {1}; }},
        {"class", [](DecodedScene& s) { s.raw.objects[0].nyu40 = 41; }},
        {"front", [](DecodedScene& s) { s.raw.objects[0].front->x() = NAN; }},
        {"axis", [](DecodedScene& s) { s.raw.file_up_axis = 'w'; }},
        {"picture's size", [](DecodedScene& s) { s.textures.textures[0].width = 3; }},
        {"huge picture", [](DecodedScene& s) { s.textures.textures[0].width = 1 << 30; }},
        {"pictures", [](DecodedScene& s) { s.textures.textures.pop_back(); }},
        {"count of pictures", [](DecodedScene& s) { s.textures.found = 2; }}};
    for (const auto& [name, spoil] : cases) {
        DecodedScene scene = test::smallDecodedScene();
        spoil(scene);
        bool damaged = false;
        EXPECT_FALSE(deserializeScene(test::serialized(scene), damaged)) << name;
        EXPECT_TRUE(damaged) << name;
    }
}

}  // namespace
}  // namespace dollytrack::scene_serialization_test
