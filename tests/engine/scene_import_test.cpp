#include "engine/io/import/scene_import.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/labels.h"
#include "engine/scene/scene_report.h"
#include "tests/support/imported_scene.h"
#include "tests/support/obj_writer.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace dollytrack::scene_import_test {
namespace {

using test::countTargets;
using test::find;
using test::imported;
using test::ObjWriter;
using test::says;
using test::TempFolder;

/// A bedroom 4 x 3 x 2.6 m: bed at the west wall, table with a cup, picture on the north wall.
std::string bedroom(double units_per_metre, bool y_up) {
    ObjWriter obj(units_per_metre, y_up);
    obj.room({4, 3, 2.6}, true);
    obj.object("bed").box({0.05, 0.5, 0}, {2.05, 1.9, 0.5});
    obj.object("desk").box({3.2, 0.8, 0}, {3.9, 2.2, 0.74});
    obj.object("coffee_cup").box({3.4, 1.2, 0.74}, {3.5, 1.3, 0.84});
    obj.object("chair").box({2.5, 1.2, 0}, {2.95, 1.65, 0.9});
    obj.object("wall_picture").box({1.5, 2.97, 1.2}, {2.3, 2.99, 1.8});
    return obj.text();
}

TEST(SceneImport, ReadsANamedRoom) {
    const TempFolder folder;
    const Scene scene = imported(folder.write("room.obj", bedroom(1.0, true)));
    ASSERT_EQ(scene.objects.size(), 11U);
    EXPECT_EQ(countTargets(scene), 5);
    EXPECT_EQ(find(scene, "floor")->nyu40, kNyuFloor);
    EXPECT_EQ(find(scene, "wall_n")->role, Role::Structure);

    const Object& bed = *find(scene, "bed");
    EXPECT_TRUE(bed.box.half_size.isApprox(Eigen::Vector3d(1.0, 0.7, 0.25), 1e-5));
    EXPECT_TRUE(bed.box.center.isApprox(Eigen::Vector3d(1.05, 1.2, 0.25), 1e-5));
    EXPECT_TRUE(bed.centroid.isApprox(bed.box.center, 1e-4));
    EXPECT_EQ(bed.box.yaw, 0.0);
    EXPECT_TRUE(bed.large);
    EXPECT_FALSE(find(scene, "coffee_cup")->large);

    const Object& picture = *find(scene, "wall_picture");
    EXPECT_EQ(picture.front_source, FrontSource::Wall);
    EXPECT_TRUE(picture.front.isApprox(-Eigen::Vector3d::UnitY(), 1e-6));
    EXPECT_TRUE(scene.room_bounds.isApprox(
        Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 2.6)), 1e-5));
}

// Some exporters write an MTL file with a single line end, which assimp treats as a broken model.
TEST(SceneImport, ReadsAModelWhoseMtlFileIsAsGoodAsEmpty) {
    const TempFolder folder;
    for (const char* text : {"", "\n", "# none\n", "# no materials\n"}) {
        static_cast<void>(folder.write("room.mtl", text));
        const Scene scene =
            imported(folder.write("room.obj", "mtllib room.mtl\n" + bedroom(1.0, true)));
        EXPECT_EQ(scene.objects.size(), 11U) << '"' << text << '"';
    }
}

TEST(SceneImport, KeepsEachObjectsVerticesAndTrianglesTogether) {
    const TempFolder folder;
    const Scene scene = imported(folder.write("room.obj", bedroom(1.0, true)));
    std::uint32_t triangle = 0;
    std::uint32_t vertex = 0;
    for (const Object& object : scene.objects) {
        EXPECT_EQ(object.first_triangle, triangle);
        EXPECT_EQ(object.first_vertex, vertex);
        triangle += object.triangle_count;
        vertex += object.vertex_count;
        for (std::uint32_t t = object.first_triangle; t < triangle; ++t) {
            for (const std::uint32_t index : scene.triangles[t]) {
                EXPECT_GE(index, object.first_vertex);
                EXPECT_LT(index, vertex);
            }
        }
    }
    EXPECT_EQ(triangle, scene.triangles.size());
    EXPECT_EQ(vertex, scene.positions.size());
    EXPECT_EQ(scene.normals.size(), scene.positions.size());
    EXPECT_EQ(scene.uvs.size(), scene.positions.size());
}

struct FrameCase {
    const char* what;
    double units_per_metre;
    bool y_up;
    double unit_m;
};

class FrameCases : public testing::TestWithParam<FrameCase> {};

TEST_P(FrameCases, GiveTheSameWorld) {
    const TempFolder folder;
    const FrameCase& c = GetParam();
    const Scene truth =
        imported(folder.write("truth.obj", bedroom(1.0, false)), {.unit_m = 1.0, .up_axis = 'z'});
    const Scene scene = imported(folder.write("room.obj", bedroom(c.units_per_metre, c.y_up)));
    EXPECT_NEAR(scene.report.unit_m, c.unit_m, 1e-12);
    EXPECT_EQ(scene.report.up_axis, c.y_up ? "y" : "z");
    ASSERT_EQ(scene.objects.size(), truth.objects.size());
    for (std::size_t i = 0; i < truth.objects.size(); ++i) {
        EXPECT_TRUE((scene.objects[i].box.center - truth.objects[i].box.center).norm() < 1e-5)
            << truth.objects[i].name;
    }
    // The inverse maps a world point to the file's coordinates.
    const Eigen::Vector3d at = scene.source_from_world * Eigen::Vector3d(1, 2, 3);
    const Eigen::Vector3d expected =
        c.units_per_metre * (c.y_up ? Eigen::Vector3d(1, 3, -2) : Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(at.isApprox(expected, 1e-9));
}

INSTANTIATE_TEST_SUITE_P(Frames, FrameCases,
                         testing::Values(FrameCase{"metres, y up", 1.0, true, 1.0},
                                         FrameCase{"metres, z up", 1.0, false, 1.0},
                                         FrameCase{"centimetres, y up", 100.0, true, 0.01},
                                         FrameCase{"centimetres, z up", 100.0, false, 0.01},
                                         FrameCase{"millimetres, y up", 1000.0, true, 0.001},
                                         FrameCase{"inches, z up", 1.0 / 0.0254, false, 0.0254}));

TEST(SceneImport, TakesUnitAndUpAxisAsGiven) {
    const TempFolder folder;
    const Scene scene =
        imported(folder.write("room.obj", bedroom(1.0, true)), {.unit_m = 0.5, .up_axis = 'z'});
    EXPECT_EQ(scene.report.unit_source, "given");
    EXPECT_EQ(scene.report.up_source, "given");
    EXPECT_NEAR(find(scene, "bed")->box.half_size.x(), 0.5, 1e-5);
    EXPECT_NEAR(scene.room_bounds.sizes().y(), 1.3, 1e-5);
}

/// Minimal glTF: a quad of two triangles under a node with any transform.
std::string gltfQuad(const std::string& node_fields) {
    // Four corners of a unit square in x-y (y up), as a base64 buffer of floats and indices.
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"painting","mesh":0)" +
           node_fields + R"(}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"buffers":[{"byteLength":60,"uri":"quad.bin"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}]})";
}

std::string quadBytes() {
    const float corners[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    std::string bytes(60, '\0');
    std::memcpy(bytes.data(), corners, 48);
    std::memcpy(bytes.data() + 48, indices, 12);
    return bytes;
}

Eigen::Vector3f firstFaceNormal(const Scene& scene) {
    const Triangle& t = scene.triangles.front();
    return (scene.positions[t[1]] - scene.positions[t[0]])
        .cross(scene.positions[t[2]] - scene.positions[t[0]])
        .normalized();
}

// glTF is in metres by its standard, but not all files comply.
TEST(SceneImport, DoubtsAUnitThatMakesADollsHouse) {
    const TempFolder folder;
    static_cast<void>(folder.write("quad.bin", quadBytes()));
    const auto warningsAt = [&](const std::string& scale) {
        std::string text = gltfQuad(",\"scale\":[" + scale + "," + scale + "," + scale + "]");
        text.replace(text.find("painting"), 8, "wall");
        const Scene scene = imported(folder.write("scaled.gltf", text));
        EXPECT_EQ(scene.report.unit_m, 1.0);
        std::string all;
        for (const std::string& warning : scene.report.warnings) all += warning + "\n";
        return all;
    };
    EXPECT_EQ(warningsAt("2.6").find("the unit is doubtful"), std::string::npos);
    EXPECT_NE(warningsAt("1.2").find("1 unit = 1 m, which makes the room 1.2 m high"),
              std::string::npos);
}

TEST(SceneImport, ReadsGltfAsMetresAndYUp) {
    const TempFolder folder;
    static_cast<void>(folder.write("quad.bin", quadBytes()));
    const Scene scene = imported(folder.write("quad.gltf", gltfQuad("")));
    EXPECT_EQ(scene.report.unit_source, "file");
    EXPECT_EQ(scene.report.up_axis, "y");
    // +z of glTF is -y of the world; the square is upright.
    EXPECT_TRUE(firstFaceNormal(scene).isApprox(Eigen::Vector3f(0, -1, 0), 1e-5F));
    EXPECT_NEAR(scene.room_bounds.max().z(), 1.0, 1e-6);
}

TEST(SceneImport, CopiesInIfcModelsHaveTheNameOfTheirProduct) {
    const TempFolder folder;
    static_cast<void>(folder.write("quad.bin", quadBytes()));
    std::string text = gltfQuad(R"(},{"name":"IfcWindow_Fixed","children":[0]},
{"name":"IfcBuildingStorey_Level1","children":[1])");
    text.replace(text.find("painting"), 8, "IfcMappedItem_node_3");
    text.replace(text.find("\"nodes\":[0]"), 11, "\"nodes\":[2]");
    const Scene scene = imported(folder.write("quad.gltf", text));
    ASSERT_EQ(scene.objects.size(), 1U);
    EXPECT_EQ(scene.objects[0].name, "IfcWindow_Fixed");
    EXPECT_EQ(scene.objects[0].nyu40, nyu40FromName("window"));
}

TEST(SceneImport, TurnsMirroredFacesBack) {
    const TempFolder folder;
    static_cast<void>(folder.write("quad.bin", quadBytes()));
    const Scene scene = imported(folder.write("quad.gltf", gltfQuad(R"(,"scale":[-1,1,1])")));
    // Mirrored in x the square still faces +z of glTF, and faces and normals agree.
    EXPECT_TRUE(firstFaceNormal(scene).isApprox(Eigen::Vector3f(0, -1, 0), 1e-5F));
    EXPECT_TRUE(scene.normals.front().isApprox(firstFaceNormal(scene), 1e-4F));
    EXPECT_NEAR(scene.room_bounds.min().x(), -1.0, 1e-6);
}

TEST(SceneImport, DropsWhatIsBrokenAndSaysSo) {
    const TempFolder folder;
    const std::string text = bedroom(1.0, true) +
                             "o broken\nv nan 0 0\nv 1 0 1\nv 1 1 1\nv 2 1 1\nv 1 0 1\n"
                             "f -5 -4 -3\nf -4 -3 -1\nf -4 -3 -2\n";
    const Scene scene = imported(folder.write("room.obj", text));
    ASSERT_NE(find(scene, "broken"), nullptr);
    EXPECT_EQ(find(scene, "broken")->triangle_count, 1U);
    for (const auto& p : scene.positions) EXPECT_TRUE(p.allFinite());
    const auto says = [](const std::vector<std::string>& lines, const std::string& part) {
        return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
            return line.find(part) != std::string::npos;
        });
    };
    EXPECT_TRUE(says(scene.report.warnings, "non-finite corner"));
    EXPECT_TRUE(says(scene.report.notes, "without area"));
}

TEST(SceneImport, DropsWhatReachesBeyondAllReach) {
    const TempFolder folder;
    for (const char* far : {"2e9", "1e20", "-1e38"}) {
        const std::string text = bedroom(1.0, true) + "o far\nv " + far +
                                 " 0 0\nv 0 1 1\nv 1 0 1\n" + "v 1 1 1\nf -4 -3 -2\nf -3 -2 -1\n";
        const Scene scene = imported(folder.write("room.obj", text));
        ASSERT_NE(find(scene, "far"), nullptr) << far;
        EXPECT_EQ(find(scene, "far")->triangle_count, 1U) << far;
        EXPECT_TRUE(std::any_of(
            scene.report.warnings.begin(), scene.report.warnings.end(),
            [](const std::string& line) { return line.find("1e9 units") != std::string::npos; }))
            << far;
        for (const auto& p : scene.positions) EXPECT_LE(p.cwiseAbs().maxCoeff(), 1e9F) << far;
    }
}

TEST(SceneImport, IgnoresFarThingsGroundsAndSkiesForTheRoomsSize) {
    const TempFolder folder;
    std::string text = bedroom(1.0, true);
    // Relative indices, so that the pieces can be appended to the room.
    text += "o ground\nv -100 0 -100\nv -100 0 100\nv 100 0 100\nv 100 0 -100\nf -4 -3 -2 -1\n";
    text += "o lost_lamp\nv 300000 0 0\nv 300001 0 0\nv 300000 1 0\nf -3 -2 -1\n";
    text +=
        "o thing_17\nv -200 -200 -200\nv 200 -200 200\nv 0 200 0\nv 200 200 -200\n"
        "f -4 -3 -2\nf -3 -2 -1\nf -4 -2 -1\nf -4 -3 -1\n";
    const Scene scene = imported(folder.write("room.obj", text));
    EXPECT_TRUE(scene.room_bounds.isApprox(
        Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 2.6)), 1e-4))
        << scene.room_bounds.sizes().transpose();
    EXPECT_EQ(find(scene, "thing_17")->role, Role::Structure);
    EXPECT_EQ(find(scene, "ground")->role, Role::Structure);
}

TEST(SceneImport, TellsWallsAndFloorByShapeWhenNamesDoNot) {
    const TempFolder folder;
    ObjWriter obj;
    obj.object("aa1").box({0, 0, -0.1}, {5, 4, 0});
    obj.object("aa2").box({0, -0.1, 0}, {5, 0, 2.6});
    obj.object("aa3").box({-0.1, 0, 0}, {0, 4, 2.6});
    obj.object("aa4").box({0, 0, 2.6}, {5, 4, 2.7});
    obj.object("aa5").box({1, 1, 0}, {2, 2, 0.8});
    obj.object("aa6").box({3, 1, 0}, {3.5, 1.5, 1.9});
    const Scene scene = imported(folder.write("room.obj", obj.text()), {.up_axis = 'y'});
    EXPECT_EQ(find(scene, "aa1")->nyu40, kNyuFloor);
    EXPECT_EQ(find(scene, "aa2")->nyu40, kNyuWall);
    EXPECT_EQ(find(scene, "aa3")->nyu40, kNyuWall);
    EXPECT_EQ(find(scene, "aa4")->nyu40, kNyuCeiling);
    EXPECT_EQ(find(scene, "aa5")->role, Role::Target);
    EXPECT_EQ(find(scene, "aa6")->role, Role::Target);
}

TEST(SceneImport, TakesASceneInOneNodeApart) {
    const TempFolder folder;
    ObjWriter obj;
    obj.object("everything").room({5, 4, 2.6}, false);
    // A table: top on four legs that touch it.
    obj.box({1, 1, 0.7}, {2.4, 1.8, 0.75});
    for (const double x : {1.05, 2.3}) {
        for (const double y : {1.05, 1.7}) obj.box({x, y, 0}, {x + 0.05, y + 0.05, 0.7});
    }
    obj.box({1.5, 1.3, 0.75}, {1.6, 1.4, 0.95});  // a vase on it
    obj.box({4.0, 3.0, 0}, {4.6, 3.8, 1.8});      // a cupboard
    const Scene scene = imported(folder.write("room.obj", obj.text()));
    EXPECT_EQ(countTargets(scene), 3);
    const auto hasTarget = [&](const Eigen::Vector3d& size) {
        return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& o) {
            return o.role == Role::Target && (2.0 * o.box.half_size - size).norm() < 1e-3;
        });
    };
    EXPECT_TRUE(hasTarget({1.4, 0.8, 0.75}));
    EXPECT_TRUE(hasTarget({0.1, 0.1, 0.2}));
    EXPECT_TRUE(hasTarget({0.6, 0.8, 1.8}));
}

TEST(SceneImport, KeepsStackedThingsApartAndMaterialPartsTogether) {
    const TempFolder folder;
    ObjWriter obj;
    obj.room({4, 3, 2.6}, true);
    obj.object("table").material("wood").box({1, 1, 0.7}, {2, 2, 0.75});
    obj.material("metal").box({1.4, 1.4, 0}, {1.6, 1.6, 0.7});
    obj.object("book_1").box({1.2, 1.2, 0.75}, {1.4, 1.5, 0.78});
    obj.object("book_2").box({1.2, 1.2, 0.78}, {1.4, 1.5, 0.81});
    obj.object("handle").box({3, 1, 0.5}, {3.02, 1.1, 0.52});
    obj.object("cabinet").box({3.02, 0.8, 0}, {3.6, 1.6, 0.9});
    const Scene scene = imported(folder.write("room.obj", obj.text()));
    EXPECT_EQ(countTargets(scene), 4);
    EXPECT_EQ(find(scene, "table")->triangle_count, 24U);
    EXPECT_EQ(find(scene, "handle"), nullptr);
    EXPECT_EQ(find(scene, "cabinet")->triangle_count, 24U);
}

// "inner" denotes a part, but it touches no other object.
TEST(SceneImport, KeepsNamedThingsThatTouchNothingAndNamesWhatItPutsTogether) {
    const TempFolder folder;
    const auto room = [](double gap) {
        ObjWriter obj(1.0, true);
        obj.room({4, 3, 2.6}, true);
        obj.object("crate_outer").box({2, 1, 0}, {2.6, 1.6, 0.5});
        obj.object("gem_inner").box({2.2, 1.2, 0.15}, {2.4, 1.4, 0.35});
        obj.object("chest").box({0.1, 0.1, 0}, {0.9, 0.6, 0.7});
        obj.object("handle").box({0.4, 0.6 + gap, 0.5}, {0.5, 0.62 + gap, 0.52});
        return obj.text();
    };
    const auto notes = [](const Scene& scene) {
        std::string all;
        for (const std::string& note : scene.report.notes) all += note + "\n";
        return all;
    };
    const Scene mounted = imported(folder.write("mounted.obj", room(0.02)));
    EXPECT_TRUE(find(mounted, "gem_inner"));
    EXPECT_TRUE(find(mounted, "crate_outer"));
    EXPECT_FALSE(find(mounted, "handle"));
    EXPECT_NE(notes(mounted).find("attached to (--keep-meshes leaves them apart): handle with "
                                  "chest\n"),
              std::string::npos)
        << notes(mounted);
    const Scene away = imported(folder.write("away.obj", room(0.1)));
    EXPECT_TRUE(find(away, "handle"));
    EXPECT_EQ(notes(away).find("merged with"), std::string::npos) << notes(away);
}

TEST(SceneImport, MakesScatteredThingsOfOneNodeObjectsOfTheirOwn) {
    const TempFolder folder;
    ObjWriter obj;
    obj.room({6, 4, 2.6}, true);
    obj.object("lamps").box({1, 1, 2.4}, {1.2, 1.2, 2.6}).box({4, 1, 2.4}, {4.2, 1.2, 2.6});
    obj.box({4, 3, 2.4}, {4.2, 3.2, 2.6});
    const Scene scene = imported(folder.write("room.obj", obj.text()));
    EXPECT_EQ(countTargets(scene), 3);
    ASSERT_NE(find(scene, "lamps_2"), nullptr);
    EXPECT_EQ(find(scene, "lamps_2")->nyu40, nyu40FromName("lamp"));
}

TEST(SceneImport, GivesTheSameSceneEveryTime) {
    const TempFolder folder;
    const auto path = folder.write("room.obj", bedroom(100.0, true));
    const Scene a = imported(path);
    const Scene b = imported(path);
    EXPECT_EQ(toJson(a).dump(), toJson(b).dump());
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.source_sha256.size(), 64U);
}

TEST(SceneImport, GivesTheSameSceneWithAnyNumberOfThreads) {
    const TempFolder folder;
    const auto path = folder.write("room.obj", bedroom(1.0, true));
    setThreadCount(1);
    const Scene one = imported(path);
    setThreadCount(0);
    const Scene all = imported(path);
    EXPECT_EQ(toJson(one).dump(), toJson(all).dump());
    EXPECT_EQ(one.triangles, all.triangles);
    EXPECT_EQ(one.positions, all.positions);
    EXPECT_EQ(one.normals, all.normals);
}

TEST(SceneImport, JoinsCornersThatAgreeAndKeepsTheOthers) {
    const TempFolder folder;
    ObjWriter obj;
    obj.room({4, 3, 2.6}, true);
    obj.object("cabinet").box({1, 1, 0}, {2, 2, 0.9});
    const Scene scene = imported(folder.write("room.obj", obj.text()));
    // Each side of a box has its own four vertices, because its edges are sharp.
    EXPECT_EQ(find(scene, "cabinet")->vertex_count, 24U);
}

TEST(SceneImport, CountsTexturesFoundAndMissing) {
    const TempFolder folder;
    // A PPM texture in another folder, with other letter case.
    static_cast<void>(folder.write("maps/Wood.PPM", "P6\n1 1\n255\n\x10\x20\x30"));
    static_cast<void>(folder.write("room.mtl",
                                   "newmtl wood\nmap_Kd C:\\scenes\\wood.ppm\nnewmtl gone\n"
                                   "map_Kd gone.png\n"));
    ObjWriter obj;
    obj.room({4, 3, 2.6}, true);
    obj.object("table").material("wood").box({1, 1, 0}, {2, 2, 0.7});
    obj.object("chair").material("gone").box({3, 1, 0}, {3.4, 1.4, 0.9});
    const Scene scene = imported(folder.write("room.obj", "mtllib room.mtl\n" + obj.text()));
    EXPECT_EQ(scene.report.textures_found, 1);
    ASSERT_EQ(scene.report.textures_missing.size(), 1U);
    EXPECT_EQ(scene.report.textures_missing[0], "gone.png");
    const Material& wood =
        scene.materials[scene.triangle_material[find(scene, "table")->first_triangle]];
    ASSERT_GE(wood.texture, 0);
    const Texture& texture = scene.textures[wood.texture];
    EXPECT_EQ(texture.rgba, (std::vector<std::uint8_t>{0x10, 0x20, 0x30, 0xFF}));
}

TEST(SceneImport, RefusesPicturesOfAnySize) {
    const TempFolder folder;
    const std::string signature("\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR", 16);
    const std::string rest("\x08\x06\0\0\0\0\0\0\0", 9);
    // The product of the sides overflows, is 0 modulo 2^64, or is too large.
    for (const std::string& sides :
         {std::string("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"), std::string("\x80\0\0\0\x80\0\0\0", 8),
          std::string("\0\0\x40\0\0\0\x40\0", 8)}) {
        static_cast<void>(folder.write("huge.png", signature + sides + rest));
        static_cast<void>(folder.write("room.mtl", "newmtl huge\nmap_Kd huge.png\n"));
        ObjWriter obj;
        obj.room({4, 3, 2.6}, true);
        obj.object("table").material("huge").box({1, 1, 0}, {2, 2, 0.7});
        const Scene scene = imported(folder.write("room.obj", "mtllib room.mtl\n" + obj.text()));
        ASSERT_EQ(scene.textures.size(), 1U);
        EXPECT_EQ(scene.textures[0].width, 0);
        EXPECT_EQ(scene.report.warnings.back(), "the texture huge.png cannot be decoded");
    }
}

TEST(SceneImport, MakesEveryNameValidText) {
    const TempFolder folder;
    static_cast<void>(folder.write("h\xF6lz.ppm", "P6\n1 1\n255\n\x10\x20\x30"));
    static_cast<void>(folder.write("room.mtl",
                                   "newmtl h\xF6lz\nmap_Kd h\xF6lz.ppm\nnewmtl fort\n"
                                   "map_Kd f\xFCr.png\nnewmtl kaputt\nmap_Kd b\xF6s.ppm\n"));
    static_cast<void>(folder.write("b\xF6s.ppm", "P6"));
    ObjWriter obj;
    obj.room({4, 3, 2.6}, true);
    obj.object("B\xFCro_table\x1B").material("h\xF6lz").box({1, 1, 0}, {2, 2, 0.7});
    obj.object("chair").material("fort").box({3, 1, 0}, {3.4, 1.4, 0.9});
    obj.object("bed").material("kaputt").box({0.1, 2, 0}, {2, 2.9, 0.4});
    const Scene scene = imported(folder.write("r\xE4um.obj", "mtllib room.mtl\n" + obj.text()));
    const std::string bad = "\xEF\xBF\xBD";
    const Object* table = find(scene, "B" + bad + "ro_table");
    ASSERT_NE(table, nullptr);
    EXPECT_EQ(scene.name, "r" + bad + "um");
    const Material& wood = scene.materials[scene.triangle_material[table->first_triangle]];
    EXPECT_EQ(wood.name, "h" + bad + "lz");
    // Found by its bytes on disk, shown as valid text.
    EXPECT_EQ(scene.report.textures_found, 1);
    EXPECT_EQ(scene.textures[wood.texture].name, "h" + bad + "lz.ppm");
    EXPECT_EQ(scene.report.textures_missing, std::vector<std::string>{"f" + bad + "r.png"});
    EXPECT_NO_THROW(static_cast<void>(toJson(scene).dump()));
}

TEST(SceneReport, HoldsWhatInfoShows) {
    const TempFolder folder;
    const Scene scene = imported(folder.write("room.obj", bedroom(1.0, true)));
    const auto json = toJson(scene);
    EXPECT_EQ(json["targets"], 5);
    EXPECT_EQ(json["classes"]["wall"], 4);
    EXPECT_EQ(json["objects"][6]["name"], "bed");
    EXPECT_EQ(json["objects"][6]["size_m"], nlohmann::json({2.0, 1.4, 0.5}));
    EXPECT_NE(describeScene(scene).find("coffee_cup"), std::string::npos);
}

}  // namespace
}  // namespace dollytrack::scene_import_test
