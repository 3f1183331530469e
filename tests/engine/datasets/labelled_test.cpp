#include "engine/io/import/ply_mesh.h"
#include "engine/scene/labels.h"
#include "tests/support/glb_writer.h"
#include "tests/support/imported_scene.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace dollytrack {
namespace {

using Eigen::Vector3f;
using test::find;
using test::imported;
using test::says;
using test::TempFolder;

/// Boxes of twelve triangles, z up, each with a number.
struct NumberedBox {
    Vector3f low;
    Vector3f high;
    int number;
};

struct Triangles {
    std::vector<Vector3f> positions;
    std::vector<std::array<int, 3>> faces;
    std::vector<int> of_face;
    std::vector<int> of_position;
};

Triangles trianglesOf(const std::vector<NumberedBox>& boxes) {
    Triangles all;
    for (const NumberedBox& box : boxes) {
        const int base = static_cast<int>(all.positions.size());
        for (int i = 0; i < 8; ++i) {
            all.positions.emplace_back((i & 1) != 0 ? box.high.x() : box.low.x(),
                                       (i & 2) != 0 ? box.high.y() : box.low.y(),
                                       (i & 4) != 0 ? box.high.z() : box.low.z());
            all.of_position.push_back(box.number);
        }
        for (const std::array<int, 4>& quad :
             {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
              std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
            all.faces.push_back({base + quad[0], base + quad[1], base + quad[2]});
            all.faces.push_back({base + quad[0], base + quad[2], base + quad[3]});
            all.of_face.insert(all.of_face.end(), 2, box.number);
        }
    }
    return all;
}

/// A room of 4 x 3 x 2.5 m in slabs, two chairs and a lamp.
std::vector<NumberedBox> numberedRoom(int floor, int wall, int chair, int other, int lamp) {
    return {{{0, 0, -0.1F}, {4, 3, 0}, floor},        {{0, 0, 0}, {4, 0.1F, 2.5F}, wall},
            {{0, 2.9F, 0}, {4, 3, 2.5F}, wall},       {{0, 0, 0}, {0.1F, 3, 2.5F}, wall},
            {{3.9F, 0, 0}, {4, 3, 2.5F}, wall},       {{1, 1, 0}, {1.5F, 1.5F, 0.9F}, chair},
            {{2.5F, 1, 0}, {3, 1.5F, 0.9F}, other},   {{2, 2, 0}, {2.2F, 2.2F, 1.5F}, lamp}};
}

std::string asciiPly(const Triangles& mesh, bool faces_numbered, const std::string& property) {
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
         << "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!faces_numbered) text << "property ushort " << property << "\n";
    text << "element face " << mesh.faces.size() << "\nproperty list uchar int vertex_indices\n";
    if (faces_numbered) text << "property int " << property << "\n";
    text << "end_header\n";
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        text << mesh.positions[i].transpose();
        if (!faces_numbered) text << " " << mesh.of_position[i];
        text << "\n";
    }
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        text << "3 " << mesh.faces[i][0] << " " << mesh.faces[i][1] << " " << mesh.faces[i][2];
        if (faces_numbered) text << " " << mesh.of_face[i];
        text << "\n";
    }
    return text.str();
}

/// How many triangles each object has.
std::map<std::string, std::size_t> trianglesByName(const Scene& scene) {
    std::map<std::string, std::size_t> counts;
    for (const Object& object : scene.objects) counts[object.name] = object.triangle_count;
    return counts;
}

using Counts = std::map<std::string, std::size_t>;

TEST(Labelled, ReplicasFacesAreTheObjectsOfItsInfo) {
    const TempFolder folder;
    const auto path =
        folder.write("mesh_semantic.ply",
                     asciiPly(trianglesOf(numberedRoom(3, 8, 11, 12, 40)), true, "object_id"));
    static_cast<void>(folder.write("info_semantic.json", R"({"objects": [
 {"id": 3, "class_id": 40, "class_name": "floor"}, {"id": 8, "class_name": "wall"},
 {"id": 11, "class_name": "chair"}, {"id": 12, "class_name": "chair"}]})"));
    const Scene scene = imported(path);
    EXPECT_EQ(trianglesByName(scene),
              (Counts{{"floor", 12}, {"wall", 48}, {"chair", 12}, {"chair_2", 12}, {"unlabelled", 12}}));
    EXPECT_EQ(find(scene, "chair_2")->nyu40, nyu40FromName("chair"));
    EXPECT_EQ(find(scene, "wall")->role, Role::Structure);
    EXPECT_EQ(find(scene, "unlabelled")->role, Role::Structure) << "40 is not in the list";
    EXPECT_EQ(test::countTargets(scene), 2);
}

TEST(Labelled, ScanNetsVerticesHaveNyu40Classes) {
    const TempFolder folder;
    // 5 chair, 35 lamp, 2 floor, 1 wall.
    const std::string labels =
        asciiPly(trianglesOf(numberedRoom(2, 1, 5, 5, 35)), false, "label");
    const auto path = folder.write("scene0000_00_vh_clean_2.labels.ply", labels);
    const Scene alone = imported(path);
    EXPECT_EQ(trianglesByName(alone),
              (Counts{{"floor", 12}, {"wall", 12}, {"wall_2", 12}, {"wall_3", 12}, {"wall_4", 12},
                      {"chair", 12}, {"chair_2", 12}, {"lamp", 12}}));
    // With its segments, objects are those of the aggregation; the class is the labels'.
    std::string segments = "0";
    for (int i = 1; i < 64; ++i) segments += "," + std::to_string(i / 8);
    static_cast<void>(folder.write("scene0000_00_vh_clean_2.0.010000.segs.json",
                                   R"({"segIndices": [)" + segments + "]}"));
    static_cast<void>(folder.write("scene0000_00.aggregation.json", R"({"segGroups": [
 {"objectId": 0, "segments": [0], "label": "floor"},
 {"objectId": 1, "segments": [1, 2, 3, 4], "label": "wall"},
 {"objectId": 2, "segments": [5, 6], "label": "office bench"}]})"));
    const Scene scene = imported(path);
    EXPECT_EQ(trianglesByName(scene),
              (Counts{{"floor", 12}, {"wall", 48}, {"office bench", 24}, {"unlabelled", 12}}));
    EXPECT_EQ(find(scene, "office bench")->nyu40, nyu40FromName("chair"));
}

TEST(Labelled, HabitatsColoursAreTheObjectsOfItsText) {
    const TempFolder folder;
    const Triangles mesh = trianglesOf(numberedRoom(1, 2, 3, 4, 5));
    test::GlbWriter writer;
    std::vector<std::uint8_t> colors;
    for (const int number : mesh.of_position) {
        colors.insert(colors.end(), {static_cast<std::uint8_t>(10 * number), 0x20, 0xF0, 255});
    }
    std::vector<std::uint32_t> indices;
    for (const auto& face : mesh.faces) {
        for (const int index : face) indices.push_back(static_cast<std::uint32_t>(index));
    }
    const auto position =
        writer.addAccessor(writer.addView(mesh.positions), 5126, "VEC3", mesh.positions.size());
    const auto color =
        writer.addAccessor(writer.addView(colors), 5121, "VEC4", mesh.positions.size(), true);
    const auto index = writer.addAccessor(writer.addView(indices), 5125, "SCALAR", indices.size());
    writer.addMesh("all", {{"attributes", {{"POSITION", position}, {"COLOR_0", color}}},
                           {"indices", index}});
    static_cast<void>(folder.write("house.semantic.txt",
                                   "HM3D Semantic Annotations\n1,0A20F0,\"floor\",0\n"
                                   "2,1420F0,\"wall\",0\n3,1E20F0,\"chair\",0\n"
                                   "4,2820F0,\"bed side table\",0\n5,3220F0,\"lamp\",0\n"));
    const auto labelled = folder.write("house.semantic.glb", writer.glb());
    const Counts expected = {
        {"floor", 12}, {"wall", 48}, {"chair", 12}, {"bed side table", 12}, {"lamp", 12}};
    EXPECT_EQ(trianglesByName(imported(labelled)), expected);

    // The mesh with the room's colours: the same room, y up, without colours of objects.
    test::GlbWriter pictured;
    std::vector<Vector3f> turned;
    for (const Vector3f& p : mesh.positions) turned.emplace_back(p.x(), p.z(), -p.y());
    const auto other =
        pictured.addAccessor(pictured.addView(turned), 5126, "VEC3", turned.size());
    const auto order =
        pictured.addAccessor(pictured.addView(indices), 5125, "SCALAR", indices.size());
    pictured.addMesh("all", {{"attributes", {{"POSITION", other}}}, {"indices", order}});
    EXPECT_EQ(trianglesByName(imported(folder.write("house.glb", pictured.glb()))), expected);
    static_cast<void>(folder.write("house.semantic.txt", "title\n1,0A20F,floor,0\n"));
    const Result<Scene> damaged = importScene(labelled);
    ASSERT_FALSE(damaged);
    EXPECT_TRUE(damaged.error().where.ends_with("house.semantic.txt:2")) << damaged.error().where;
}

TEST(Labelled, MatterportsFacesAreTheObjectsOfItsHouse) {
    const TempFolder folder;
    const auto path =
        folder.write("abc_semantic.ply",
                     asciiPly(trianglesOf(numberedRoom(0, 1, 2, 3, 4)), true, "object_id"));
    static_cast<void>(folder.write(
        "abc.house",
        "ASCII 1.1\nC  0  1 floor 2 floor 0 0 0 0 0\nC 1 2 wall 1 wall 0 0 0 0 0\n"
        "C 2 3 dining#chair 3 chair 0 0 0 0 0\nC 3 4 coat#rack 39 objects 0 0 0 0 0\n"
        "O 0 0 0 1 1 1\nO 1 0 1 1 1 1\nO 2 0 2 1 1 1\nO 3 0 2 1 1 1\nO 4 0 3 1 1 1\n"));
    EXPECT_EQ(trianglesByName(imported(path)),
              (Counts{{"floor", 12}, {"wall", 48}, {"chair", 12}, {"chair_2", 12}, {"coat rack", 12}}));
}

/// Little-endian, as in test files here.
template <class T>
void append(std::string& bytes, T value) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    bytes.append(raw.data(), raw.size());
}

// A line feed behind the header is a number's first byte, and no end of a line.
TEST(PlyMesh, TheFirstByteMayBeALineFeed) {
    const Triangles mesh = trianglesOf({{{0, 0, 0}, {1, 2, 3}, 0}});
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\n"
        "property float y\nproperty float z\nelement face 12\n"
        "property list uchar int vertex_indices\nend_header\n";
    for (const Vector3f& p : mesh.positions) {
        for (int i = 0; i < 3; ++i) {
            std::uint32_t bits = 0;
            const float value = p[i];
            std::memcpy(&bits, &value, 4);
            append(bytes, (bits & 0xFFFFFF00U) | 0x0AU);
        }
    }
    for (const auto& face : mesh.faces) {
        append(bytes, std::uint8_t{3});
        for (const int index : face) append(bytes, std::int32_t{index});
    }
    const Result<PlyMesh> read = parsePlyMesh(bytes, "box.ply");
    ASSERT_TRUE(read) << describe(read.error());
    ASSERT_EQ(read->positions.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_LT((read->positions[i] - mesh.positions[i]).norm(), 1e-5F);
    }
    EXPECT_EQ(read->face_indices.size(), 36U);
    // Cut anywhere, it is damaged; big-endian bytes are the same mesh.
    for (std::size_t length = 0; length < bytes.size(); length += 7) {
        EXPECT_FALSE(parsePlyMesh(bytes.substr(0, length), "box.ply")) << length;
    }
}

TEST(PlyMesh, ReadsStripsAndPlacesOfCorners) {
    const Result<PlyMesh> strips = parsePlyMesh(
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n8 0 1 2 3 -1 1 4 3\n",
        "s.ply");
    ASSERT_TRUE(strips) << describe(strips.error());
    EXPECT_EQ(strips->face_indices, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 1, 4, 3}));
    const Result<PlyMesh> corners = parsePlyMesh(
        "ply\nformat ascii 1.0\ncomment TextureFile wood.png\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n3 2 0 1 6 0.1 0.2 0.3 0.4 0.5 0.6\n",
        "c.ply");
    ASSERT_TRUE(corners) << describe(corners.error());
    EXPECT_EQ(corners->texture, "wood.png");
    ASSERT_EQ(corners->uvs.size(), 3U);
    EXPECT_TRUE(corners->positions[0].isApprox(Vector3f(0, 1, 0)));
    EXPECT_TRUE(corners->uvs[2].isApprox(Vector3f(0.5F, 0.6F, 0)));
}

}  // namespace
}  // namespace dollytrack
