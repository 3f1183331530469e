#include "engine/io/files/png_writer.h"
#include "engine/io/semantics/labelled_surface.h"
#include "engine/scene/labels.h"
#include "tests/engine/datasets/numbered_mesh.h"
#include "tests/support/glb_writer.h"
#include "tests/support/imported_scene.h"
#include "tests/support/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::labelled_test {
namespace {

using Eigen::Vector3f;
using test::asciiPly;
using test::find;
using test::imported;
using test::NumberedBox;
using test::numberedRoom;
using test::says;
using test::TempFolder;
using test::Triangles;
using test::trianglesOf;

/// Number of triangles by object name.
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
    EXPECT_EQ(
        trianglesByName(scene),
        (Counts{{"floor", 12}, {"wall", 48}, {"chair", 12}, {"chair_2", 12}, {"unlabelled", 12}}));
    EXPECT_EQ(find(scene, "chair_2")->nyu40, nyu40FromName("chair"));
    EXPECT_EQ(find(scene, "wall")->role, Role::Structure);
    EXPECT_EQ(find(scene, "unlabelled")->role, Role::Structure) << "40 is not in the list";
    EXPECT_EQ(test::countTargets(scene), 2);
}

TEST(Labelled, ScanNetsVerticesHaveNyu40Classes) {
    const TempFolder folder;
    // 5 chair, 35 lamp, 2 floor, 1 wall.
    const std::string labels = asciiPly(trianglesOf(numberedRoom(2, 1, 5, 5, 35)), false, "label");
    const auto path = folder.write("scene0000_00_vh_clean_2.labels.ply", labels);
    const Scene alone = imported(path);
    EXPECT_EQ(trianglesByName(alone), (Counts{{"floor", 12},
                                              {"wall", 12},
                                              {"wall_2", 12},
                                              {"wall_3", 12},
                                              {"wall_4", 12},
                                              {"chair", 12},
                                              {"chair_2", 12},
                                              {"lamp", 12}}));
    // With segments, objects are those of the aggregation; classes are those of the labels.
    std::string segments = "0";
    for (int i = 1; i < 64; ++i) segments += fmt::format(",{}", i / 8);
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
    // The mesh with colours has the same vertices; both files can be opened.
    std::string red = asciiPly(trianglesOf(numberedRoom(255, 255, 255, 255, 255)), false, "red");
    red.replace(red.find("property ushort red"), 19, "property uchar red");
    red.insert(red.find("element face"), "property uchar green\nproperty uchar blue\n");
    std::size_t at = red.find("end_header");
    for (int i = 0; i < 64; ++i) {
        at = red.find(" 255\n", at);
        red.insert(at + 4, " 0 0");
    }
    const auto pictured = folder.write("scene0000_00_vh_clean_2.ply", red);
    for (const auto& opened : {path, pictured}) {
        const Scene both = imported(opened);
        EXPECT_EQ(trianglesByName(both), trianglesByName(scene));
        EXPECT_TRUE(std::ranges::all_of(both.materials, [](const Material& material) {
            return material.base_color.isApprox(Vector3f(1, 0, 0));
        }));
    }
}

std::vector<std::uint32_t> indicesOf(const Triangles& mesh) {
    std::vector<std::uint32_t> indices;
    for (const auto& face : mesh.faces) {
        for (const int index : face) indices.push_back(static_cast<std::uint32_t>(index));
    }
    return indices;
}

/// The mesh as .glb, z up, with object colours 0xHH20F0, where HH is ten times the number.
std::string coloredGlb(const Triangles& mesh, int placements = 1) {
    test::GlbWriter writer;
    std::vector<std::uint8_t> colors;
    for (const int number : mesh.of_position) {
        colors.insert(colors.end(), {static_cast<std::uint8_t>(10 * number), 0x20, 0xF0, 255});
    }
    const std::vector<std::uint32_t> indices = indicesOf(mesh);
    const auto position =
        writer.addAccessor(writer.addView(mesh.positions), 5126, "VEC3", mesh.positions.size());
    const auto color =
        writer.addAccessor(writer.addView(colors), 5121, "VEC4", mesh.positions.size(), true);
    const auto index = writer.addAccessor(writer.addView(indices), 5125, "SCALAR", indices.size());
    writer.addMesh(
        "all", {{"attributes", {{"POSITION", position}, {"COLOR_0", color}}}, {"indices", index}});
    for (int i = 1; i < placements; ++i) {
        writer.json["nodes"].push_back({{"mesh", 0}});
        writer.json["scenes"][0]["nodes"].push_back(i);
    }
    return writer.glb();
}

/// The mesh as .glb with triangles only.
std::string plainGlb(const Triangles& mesh, bool y_up) {
    test::GlbWriter writer;
    std::vector<Vector3f> positions = mesh.positions;
    for (Vector3f& p : positions) {
        if (y_up) p = {p.x(), p.z(), -p.y()};
    }
    const std::vector<std::uint32_t> indices = indicesOf(mesh);
    const auto position =
        writer.addAccessor(writer.addView(positions), 5126, "VEC3", positions.size());
    const auto index = writer.addAccessor(writer.addView(indices), 5125, "SCALAR", indices.size());
    writer.addMesh("all", {{"attributes", {{"POSITION", position}}}, {"indices", index}});
    return writer.glb();
}

constexpr const char* kHouseText =
    "HM3D Semantic Annotations\n1,0A20F0,\"floor\",0\n2,1420F0,\"wall\",0\n"
    "3,1E20F0,\"chair\",0\n4,2820F0,\"bed side table\",0\n5,3220F0,\"lamp\",0\n";
const Counts kHouse = {
    {"floor", 12}, {"wall", 48}, {"chair", 12}, {"bed side table", 12}, {"lamp", 12}};

TEST(Labelled, RScansVerticesHaveObjectsAndNyu40Classes) {
    const TempFolder folder;
    // A second number of each vertex is its NYU40 class: sofa for the objects 7 to 9.
    std::string ply = asciiPly(trianglesOf(numberedRoom(1, 2, 7, 8, 9)), false, "objectId");
    ply.insert(ply.find("element face"), "property uchar NYU40\n");
    std::size_t at = ply.find("end_header\n") + 11;
    for (int i = 0; i < 64; ++i) {
        const std::size_t end = ply.find('\n', at);
        const char number = ply[end - 1];
        const std::string added = number == '1' ? " 2" : number == '2' ? " 1" : " 6";
        ply.insert(end, added);
        at = end + added.size() + 1;
    }
    const auto path = folder.write("labels.instances.annotated.v2.ply", ply);
    const Scene alone = imported(path);
    EXPECT_EQ(trianglesByName(alone),
              (Counts{{"floor", 12}, {"wall", 48}, {"sofa", 12}, {"sofa_2", 12}, {"sofa_3", 12}}));
    EXPECT_EQ(find(alone, "wall")->role, Role::Structure);
    static_cast<void>(folder.write("semseg.v2.json", R"({"segGroups": [
 {"objectId": 1, "label": "floor"}, {"objectId": 2, "label": "wall"},
 {"objectId": 7, "label": "couch"}, {"objectId": 8, "label": "side table"}]})"));
    const Scene scene = imported(path);
    EXPECT_EQ(
        trianglesByName(scene),
        (Counts{
            {"floor", 12}, {"wall", 48}, {"couch", 12}, {"side table", 12}, {"unlabelled", 12}}));
    EXPECT_EQ(find(scene, "couch")->nyu40, nyu40FromName("sofa"));
}

TEST(Labelled, HabitatsColoursAreTheObjectsOfItsText) {
    const TempFolder folder;
    const Triangles mesh = trianglesOf(numberedRoom(1, 2, 3, 4, 5));
    static_cast<void>(folder.write("house.semantic.txt", kHouseText));
    const auto labelled = folder.write("house.semantic.glb", coloredGlb(mesh));
    EXPECT_EQ(trianglesByName(imported(labelled)), kHouse);
    // The mesh with the room's colours: the same room, y up, without object colours.
    EXPECT_EQ(trianglesByName(imported(folder.write("house.glb", plainGlb(mesh, true)))), kHouse);
    static_cast<void>(folder.write("house.semantic.txt", "title\n1,0A20F,floor,0\n"));
    const Result<Scene> damaged = importScene(labelled);
    ASSERT_FALSE(damaged);
    EXPECT_TRUE(damaged.error().where.ends_with("house.semantic.txt:2")) << damaged.error().where;
}

// A file of a few hundred kilobytes that places 60,030,000 triangles.
TEST(Labelled, PlacementsBeyondTheBudgetAreRefused) {
    const TempFolder folder;
    Triangles mesh = trianglesOf({{{0, 0, 0}, {1, 1, 1}, 1}});
    const std::array<int, 3> face = mesh.faces.front();
    mesh.faces.assign(30'000, face);
    static_cast<void>(folder.write("house.semantic.txt", kHouseText));
    const Result<Scene> scene =
        importScene(folder.write("house.semantic.glb", coloredGlb(mesh, 2'001)));
    ASSERT_FALSE(scene);
    EXPECT_NE(scene.error().message.find("60000000 triangles"), std::string::npos)
        << scene.error().message;
}

// Triangles of 0.1 mm, 0.2 mm apart, as in a file in kilometres; the third equals the second.
TEST(LabelledSurface, TellsSmallTrianglesApart) {
    RawScene labelled;
    for (const float z : {0.0F, 2e-4F, 2e-4F}) {
        MeshPart part;
        part.positions = {{0, 0, z}, {1e-4F, 0, z}, {0, 1e-4F, z}};
        part.triangles = {{0, 1, 2}};
        for (const Vector3f& p : part.positions) part.bounds.extend(p);
        SourceObject object;
        object.parts = {labelled.parts.size()};
        labelled.parts.push_back(std::move(part));
        labelled.objects.push_back(std::move(object));
    }
    const semantics::LabelledSurface surface(labelled);
    const int expected[] = {1, 2, 2};
    for (std::size_t i = 0; i < 3; ++i) {
        const MeshPart& part = labelled.parts[i];
        const auto corners = semantics::cornersOf(part, part.triangles[0]);
        EXPECT_EQ(surface.objectAt(corners, 1e-5), expected[i]) << i;
        EXPECT_LT(surface.distance(semantics::middleOf(corners), 1e-5), 1e-9) << i;
    }
}

// This room's box is equal for rotations about x by -90, 0 and 90 degrees.
TEST(Labelled, OfEqualBoxesTheTurnThatFitsTheSurfacesCounts) {
    const TempFolder folder;
    const Triangles mesh = trianglesOf({{{0, -1.5F, -1.5F}, {4, 1.5F, -1.4F}, 1},
                                        {{0, -1.5F, -1.5F}, {4, -1.4F, 1.5F}, 2},
                                        {{0, 1.4F, -1.5F}, {4, 1.5F, 1.5F}, 2},
                                        {{0, -1.5F, -1.5F}, {0.1F, 1.5F, 1.5F}, 2},
                                        {{3.9F, -1.5F, -1.5F}, {4, 1.5F, 1.5F}, 2},
                                        {{1, -0.5F, -1.4F}, {1.5F, 0, -0.5F}, 3},
                                        {{2.5F, -0.5F, -1.4F}, {3, 0, -0.5F}, 4},
                                        {{2, 0.5F, -1.4F}, {2.2F, 0.7F, 0.1F}, 5}});
    static_cast<void>(folder.write("house.semantic.txt", kHouseText));
    static_cast<void>(folder.write("house.semantic.glb", coloredGlb(mesh)));
    for (const bool y_up : {true, false}) {
        const auto pictured = folder.write("house.glb", plainGlb(mesh, y_up));
        EXPECT_EQ(trianglesByName(imported(pictured)), kHouse) << y_up;
    }
}

// A sheet halfway between a chair and a table gets the lower number.
TEST(Labelled, AtEqualDistanceTheOrderOfBoxesDoesNotMatter) {
    std::vector<NumberedBox> boxes = numberedRoom(1, 2, 3, 4, 5);
    boxes[5] = {{1, 1, 0}, {1.5F, 1.5F, 0.9F}, 3};
    boxes[6] = {{1.625F, 1, 0}, {2.125F, 1.5F, 0.9F}, 4};
    boxes[7] = {{3, 2, 0}, {3.2F, 2.2F, 1.5F}, 5};
    for (const bool reversed : {false, true}) {
        if (reversed) std::ranges::reverse(boxes);
        const TempFolder folder;
        Triangles mesh = trianglesOf(boxes);
        static_cast<void>(folder.write("house.semantic.txt", kHouseText));
        static_cast<void>(folder.write("house.semantic.glb", coloredGlb(mesh)));
        const int base = static_cast<int>(mesh.positions.size());
        for (const float y : {1.2F, 1.3F}) {
            for (const float z : {0.3F, 0.4F}) mesh.positions.emplace_back(1.5625F, y, z);
        }
        mesh.faces.push_back({base, base + 1, base + 3});
        mesh.faces.push_back({base, base + 3, base + 2});
        Counts expected = kHouse;
        expected["chair"] += 2;
        const auto pictured = folder.write("house.glb", plainGlb(mesh, false));
        EXPECT_EQ(trianglesByName(imported(pictured)), expected) << reversed;
    }
}

// Two textures with different colours at the same position, on a mesh that is placed twice.
TEST(Labelled, ColoursOfPicturesAreObjectsToo) {
    const TempFolder folder;
    static_cast<void>(folder.write("house.semantic.txt", kHouseText));
    test::GlbWriter writer;
    const std::vector<NumberedBox> boxes = numberedRoom(1, 2, 3, 4, 5);
    const auto add = [&](const std::vector<NumberedBox>& some, bool backwards) {
        const Triangles mesh = trianglesOf(some);
        std::vector<std::uint8_t> pixels;
        for (int i = 0; i < 5; ++i) {
            const int number = backwards ? 5 - i : i + 1;
            pixels.push_back(static_cast<std::uint8_t>(10 * number));
            pixels.push_back(0x20);
            pixels.push_back(0xF0);
        }
        const auto png = encodePng(5, 1, PngFormat::Rgb8, pixels);
        const std::string bytes(png->begin(), png->end());
        std::vector<float> places;
        for (const int number : mesh.of_position) {
            const int pixel = backwards ? 5 - number : number - 1;
            places.insert(places.end(), {(static_cast<float>(pixel) + 0.5F) / 5.0F, 0.5F});
        }
        const std::size_t picture = writer.json["images"].size();
        writer.json["images"].push_back(
            {{"bufferView", writer.addView(bytes)}, {"mimeType", "image/png"}});
        writer.json["textures"].push_back({{"source", picture}});
        writer.json["materials"].push_back(
            {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", picture}}}}}});
        const std::vector<std::uint32_t> indices = indicesOf(mesh);
        const std::size_t count = mesh.positions.size();
        const auto position =
            writer.addAccessor(writer.addView(mesh.positions), 5126, "VEC3", count);
        const auto place = writer.addAccessor(writer.addView(places), 5126, "VEC2", count);
        const auto index =
            writer.addAccessor(writer.addView(indices), 5125, "SCALAR", indices.size());
        writer.addMesh("some", {{"attributes", {{"POSITION", position}, {"TEXCOORD_0", place}}},
                                {"indices", index},
                                {"material", picture}});
    };
    add({boxes.begin(), boxes.begin() + 5}, false);
    add({boxes.begin() + 5, boxes.end()}, true);
    writer.json["scenes"][0]["nodes"].push_back(2);
    writer.json["nodes"].push_back({{"mesh", 1}, {"translation", {0, 0.6, 0}}});
    const Scene scene = imported(folder.write("house.semantic.glb", writer.glb()), {.unit_m = 1.0});
    EXPECT_EQ(
        trianglesByName(scene),
        (Counts{{"floor", 12}, {"wall", 48}, {"chair", 24}, {"bed side table", 24}, {"lamp", 24}}));
    // From y = 1 of the first chair to y = 2.1 of the second.
    const Object* chair = find(scene, "chair");
    ASSERT_NE(chair, nullptr);
    EXPECT_NEAR(2.0 * chair->box.half_size.maxCoeff(), 1.1, 1e-4);
}

TEST(Labelled, MatterportsFacesAreTheObjectsOfItsHouse) {
    const TempFolder folder;
    const auto path = folder.write(
        "abc_semantic.ply", asciiPly(trianglesOf(numberedRoom(0, 1, 2, 3, 4)), true, "object_id"));
    static_cast<void>(folder.write(
        "abc.house",
        "ASCII 1.1\nC  0  1 floor 2 floor 0 0 0 0 0\nC 1 2 wall 1 wall 0 0 0 0 0\n"
        "C 2 3 dining#chair 3 chair 0 0 0 0 0\nC 3 4 coat#rack 39 objects 0 0 0 0 0\n"
        "O 0 0 0 1 1 1\nO 1 0 1 1 1 1\nO 2 0 2 1 1 1\nO 3 0 2 1 1 1\nO 4 0 3 1 1 1\n"));
    EXPECT_EQ(
        trianglesByName(imported(path)),
        (Counts{{"floor", 12}, {"wall", 48}, {"chair", 12}, {"chair_2", 12}, {"coat rack", 12}}));
}

// The boxes of ARKitScenes are not read, with a note.
TEST(Labelled, ArkitScenesBoxesAreSaidToBeLeftOut) {
    const TempFolder folder;
    const Triangles mesh = trianglesOf(numberedRoom(0, 0, 0, 0, 0));
    const auto path = folder.write("41069021_3dod_mesh.ply", asciiPly(mesh, true, "flags"));
    EXPECT_FALSE(says(imported(path).report.notes, "_3dod_annotation.json"));
    static_cast<void>(folder.write("41069021_3dod_annotation.json", R"({"data": []})"));
    const Scene scene = imported(path);
    EXPECT_TRUE(says(scene.report.notes, "41069021_3dod_annotation.json are not read"));
    EXPECT_EQ(scene.triangles.size(), mesh.faces.size());
}

TEST(Labelled, MoreThanAHundredThousandObjectsAreRefused) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 100001\nproperty list uchar int vertex_indices\n"
        "property int object_id\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
    for (int i = 0; i <= 100'000; ++i) text += "3 0 1 2 " + std::to_string(i) + "\n";
    const TempFolder folder;
    const Result<Scene> scene = importScene(folder.write("many.ply", text));
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::BadInput);
    EXPECT_NE(scene.error().message.find("100001 objects, but at most 100000"), std::string::npos)
        << scene.error().message;
}

}  // namespace
}  // namespace dollytrack::labelled_test
