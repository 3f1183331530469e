#include "engine/io/assimp/model_text_repair.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/models/model_reader.h"
#include "engine/scene/labels.h"
#include "tests/support/imported_scene.h"
#include "tests/support/obj_writer.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::awkward_scene_test {
namespace {

using Eigen::Vector3d;
using test::countTargets;
using test::furnished;
using test::importedText;
using test::ObjWriter;
using test::says;
using test::TempFolder;

TEST(AwkwardScene, UnitsThatNobodySaid) {
    for (const double units_per_metre : {1.0, 100.0, 1000.0, 1.0 / 0.0254}) {
        const Scene scene = importedText(furnished(units_per_metre).text());
        EXPECT_NEAR(scene.report.unit_m, 1.0 / units_per_metre, 1e-9);
        EXPECT_NEAR(scene.room_bounds.sizes().x(), 5.0, 1e-3);
        EXPECT_TRUE(scene.report.warnings.empty());
    }
    // Normalized to size 1: no usual unit gives the size of a room, so there is a warning.
    EXPECT_TRUE(says(importedText(furnished(0.2).text()).report.warnings, "unit is doubtful"));
}

TEST(AwkwardScene, PhysicsMeshesAreNotSeen) {
    ObjWriter obj = furnished();
    obj.object("UCX_sofa_01").box({0.15, 2.95, 0.0}, {2.25, 3.85, 0.85});
    obj.object("UBX_chair").box({1.15, 1.55, 0.0}, {1.7, 2.1, 0.95});
    obj.object("room_hull").box({0, 0, 0}, {5, 4, 2.6});
    obj.object("coffee_table_collision").box({2.0, 1.5, 0.0}, {3.2, 2.3, 0.45});
    obj.object("lamp_col").box({4.4, 0.3, 0.0}, {4.7, 0.6, 1.5});
    obj.object("hitbox.004").box({1.15, 1.55, 0.0}, {1.7, 2.1, 0.5});
    obj.object("CTRL_Hole_Door").box({4.9, 1.0, 0.0}, {5.1, 2.0, 2.0});
    obj.object("floorNavMesh").box({0.2, 0.2, 0.0}, {4.8, 3.8, 0.01});
    // Objects with similar names are kept: a column of books, a model of a ship.
    obj.object("books_col").box({4.0, 3.0, 0.0}, {4.3, 3.3, 0.4});
    obj.object("ship_hull").box({3.0, 3.2, 0.0}, {3.8, 3.5, 0.4});
    const Scene scene = importedText(obj.text());
    EXPECT_EQ(countTargets(scene), 6);
    EXPECT_TRUE(
        says(scene.report.notes,
             "8 meshes are collision shapes, navigation meshes or cutters and were left out: "));
}

TEST(AwkwardScene, ASceneOfPhysicsMeshesAloneIsShown) {
    ObjWriter obj(1.0, false);
    obj.object("UCX_crate").box({0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(importedText(obj.text()).objects.size(), 1U);
}

TEST(AwkwardScene, BoardsOfAFloorAreOneFloor) {
    ObjWriter obj = furnished();
    const int targets = countTargets(importedText(obj.text()));
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 10; ++j) {
            obj.object("Cube_" + std::to_string(10 * i + j))
                .box({1.0 * i, 0.4 * j, -0.02}, {1.0 * i + 0.98, 0.4 * j + 0.38, 0.0});
        }
    }
    const Scene scene = importedText(obj.text());
    EXPECT_TRUE(says(scene.report.notes, "49 boards or tiles were joined"));
    EXPECT_EQ(countTargets(scene), targets);
}

// Panels that leave most of the wall free are objects.
TEST(AwkwardScene, PanelsOnAWallAreNoTiles) {
    ObjWriter obj = furnished();
    const int targets = countTargets(importedText(obj.text()));
    for (int i = 0; i < 7; ++i) {
        for (int j = 0; j < 2; ++j) {
            obj.object("Cube_" + std::to_string(2 * i + j))
                .box({0.5 + 0.6 * i, 0.0, 1.1 + 0.6 * j}, {0.8 + 0.6 * i, 0.03, 1.4 + 0.6 * j});
        }
    }
    EXPECT_EQ(countTargets(importedText(obj.text())), targets + 14);
}

TEST(AwkwardScene, WhatIsThereTwiceCountsOnce) {
    ObjWriter obj = furnished();
    obj.object("sofa_copy").box({0.2, 3.0, 0.0}, {2.2, 3.8, 0.8});
    obj.object("chair_beside").box({2.2, 0.6, 0.0}, {2.65, 1.05, 0.9});  // equal, elsewhere
    const Scene scene = importedText(obj.text());
    EXPECT_EQ(countTargets(scene), 5);
    EXPECT_TRUE(says(scene.report.notes, "1 mesh occurs twice at the same position"));
}

/// A hall with crates of a metre.
ObjWriter hall(const Eigen::Vector3d& size) {
    ObjWriter obj(1.0, false);
    obj.room(size, true);
    for (int i = 0; i < 24; ++i) {
        const Eigen::Vector3d low(3.0 + 4.5 * (i / 4), 3.0 + 4.0 * (i % 4), 0.0);
        obj.object("crate_" + std::to_string(i)).box(low, low + Eigen::Vector3d::Ones());
    }
    return obj;
}

TEST(AwkwardScene, AHallIsNoRoomInFeet) {
    for (const Eigen::Vector3d& size :
         {Eigen::Vector3d(30, 20, 6), Eigen::Vector3d(40, 25, 8), Eigen::Vector3d(30, 20, 10)}) {
        const Scene scene = importedText(hall(size).text());
        EXPECT_DOUBLE_EQ(scene.report.unit_m, 1.0);
        EXPECT_TRUE(says(scene.report.warnings, "hall in metres")) << size.transpose();
        EXPECT_EQ(countTargets(scene), 24);
    }
}

/// Furniture distinguishes a room in feet from a hall in metres.
TEST(AwkwardScene, ARoomInFeetIsKnownByItsFurniture) {
    EXPECT_DOUBLE_EQ(importedText(furnished(1.0 / 0.3048).text()).report.unit_m, 0.3048);
    ObjWriter obj = hall({40, 25, 8});
    obj.object("chair").box({1.0, 1.0, 0.0}, {1.45, 1.45, 0.9});
    EXPECT_DOUBLE_EQ(importedText(obj.text()).report.unit_m, 1.0);
}

/// The OBJ text with moved vertices.
std::string moved(const ObjWriter& obj, const Eigen::Vector3d& by) {
    std::ostringstream text;
    text.precision(15);
    std::istringstream lines(obj.text());
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string kind;
        Eigen::Vector3d p;
        if (words >> kind && kind == "v" && words >> p.x() >> p.y() >> p.z()) {
            text << "v " << (p + by).transpose() << "\n";
        } else {
            text << line << "\n";
        }
    }
    return text.str();
}

TEST(AwkwardScene, FarFromTheOriginItIsSaidWhatThatCosts) {
    const TempFolder folder;
    ImportOptions options;
    options.unit_m = 1.0;
    const auto read = [&](double away) {
        const std::string text = moved(furnished(), Eigen::Vector3d(away, away, 0.0));
        return importScene(folder.write("room.obj", text), options);
    };
    const Result<Scene> near = read(1e3);  // floats are 0.1 mm apart
    ASSERT_TRUE(near) << describe(near.error());
    EXPECT_TRUE(near->report.warnings.empty());
    EXPECT_LT(near->room_bounds.center().head<2>().norm(), 1.5);  // moved into the range of maps
    const Eigen::Vector3d back = near->source_from_world * near->room_bounds.center();
    EXPECT_NEAR(back.head<2>().norm(), std::hypot(1002.5, 1002.0), 2.0);
    const Result<Scene> nearer = read(300.0);
    ASSERT_TRUE(nearer) << describe(nearer.error());
    EXPECT_GT(nearer->room_bounds.center().x(), 300.0);  // not moved
    const Result<Scene> far = read(2e5);                 // 16 mm
    ASSERT_TRUE(far) << describe(far.error());
    EXPECT_EQ(countTargets(*far), 4);
    EXPECT_TRUE(says(far->report.warnings, "from the origin"));
    const Result<Scene> farthest = read(1e9);  // 64 m
    ASSERT_FALSE(farthest);
    EXPECT_EQ(farthest.error().code, ErrorCode::BadInput);
    EXPECT_NE(farthest.error().message.find("from the origin"), std::string::npos)
        << farthest.error().message;
}

TEST(AwkwardScene, ObjectsThatFellOutOfTheWorldAreLeftOut) {
    const Scene room = importedText(furnished().text());
    ObjWriter obj = furnished();
    obj.object("trolley").box({1, 1, -5e6}, {1.5, 2, -5e6 + 8});
    obj.object("bottle").box({2, 2, -901}, {2.2, 2.2, -900});
    const Scene scene = importedText(obj.text());
    EXPECT_EQ(scene.objects.size(), room.objects.size());
    EXPECT_TRUE(scene.room_bounds.isApprox(room.room_bounds, 1e-6));
    EXPECT_EQ(scene.report.unit_m, room.report.unit_m);
    ASSERT_EQ(scene.report.warnings.size(), 1U);
    EXPECT_TRUE(says(scene.report.warnings,
                     "2 objects lie far away from all others and are left out: bottle (89"))
        << scene.report.warnings.front();
    EXPECT_TRUE(says(scene.report.warnings, "trolley (5000 km)")) << scene.report.warnings.front();

    // A neighbour's garage is near, a sky is large, and half of a scene is no exception.
    ObjWriter wide = furnished();
    wide.object("garage").box({300, 0, 0}, {305, 5, 3});
    wide.object("sky").box({-2000, -2000, -2000}, {2000, 2000, 2000});
    EXPECT_FALSE(says(importedText(wide.text()).report.warnings, "far away from all others"));
    ObjWriter twice = furnished();
    for (int i = 0; i < 8; ++i) {
        twice.object("crate_" + std::to_string(i))
            .box({3e3, 2.0 * i, 0}, {3e3 + 1, 2.0 * i + 1, 1});
    }
    EXPECT_FALSE(says(importedText(twice.text()).report.warnings, "far away from all others"));
}

/// Some exporters omit leading zeros: ".5" for "0.5".
TEST(AwkwardScene, NumbersWithoutALeadingZero) {
    const std::string text =
        "v -2.5 -.5 -2\nv 2.5 -.5 -2\nv -2.5 2.1 -2\nv 2.5 2.1 -2\n"
        "v -2.5 -.5 2\nv 2.5 -.5 2\nv -2.5 2.1 2\nv 2.5 2.1 2\nv .25\t+.5 0\n"
        "o room\nf 3 4 2 1\nf 6 8 7 5\nf 2 6 5 1\nf 7 8 4 3\nf 5 7 3 1\nf 4 8 6 2\n"
        "o chair\nf 1 2 9\n";
    const TempFolder folder;
    ImportOptions options;
    options.up_axis = 'y';
    options.unit_m = 1.0;
    const Result<Scene> scene = importScene(folder.write("room.obj", text), options);
    ASSERT_TRUE(scene) << describe(scene.error());
    EXPECT_NEAR(scene->room_bounds.sizes().z(), 2.6, 1e-6);
    EXPECT_EQ(scene->objects.size(), 2U);
    EXPECT_EQ(scene->triangles.size(), 13U);
}

TEST(AwkwardScene, NamesOfFilesKeepTheirPoints) {
    const auto bytes = [](const std::string& text) {
        return std::vector<std::uint8_t>(text.begin(), text.end());
    };
    EXPECT_FALSE(hasBarePoints(bytes("mtllib a.5.mtl\nv 0.5 1. -2.5e-3\n")));
    EXPECT_EQ(withLeadingZeros(bytes("mtllib a.5.mtl\nv -.5 1. +.25\n")),
              bytes("mtllib a.5.mtl\nv -0.5 1. +0.25\n"));
}

// Texts before and after the repair; an empty result means unchanged and not copied.
TEST(AwkwardScene, ObjLinesAreMendedWhereAssimpMisreadsThem) {
    struct Case {
        std::string text, mended;
        std::size_t faces;
    };
    const std::string far = "99999999999999999999";
    for (const Case& c : std::vector<Case>{
             {"vt 0 0\nf 1/1 2/1 3/1\n", "", 0},
             {"vt 0 0\nf 1/2 2/1 3/1\n", "vt 0 0\nf 1 2 3\n", 1},
             {"vt 0 0\nf\t1/2/7 2/1/8 3/1/9\n", "vt 0 0\nf 1//7 2//8 3//9\n", 1},
             {"  vt 0 0\n\tf 1/1 2/1 3/1\n", "vt 0 0\nf 1/1 2/1 3/1\n", 0},
             {" f 1/1 2/0 3\nvt 0 0\n", "f 1 2 3\nvt 0 0\n", 1},
             {"vt 0 0\nf 1/-1 2/-1 3/-1\nvt 1 1\n", "", 0},
             // Negative indices count back from the face, not from the end of the file.
             {"vt 0 0\nf 1/-2 2/-1 3/-1\nvt 1 1\n", "vt 0 0\nf 1 2 3\nvt 1 1\n", 1},
             {"f 1/2 2/1 3/1\nvt 0 0\nvt 1 1\n", "", 0},
             {"vt 0 0\nf 1/1 2/1 \\\r\n 3/5\nf 1 2 3\n", "vt 0 0\nf 1 2 3\nf 1 2 3\n", 1},
             {"f 1/" + far + " 2 3\n", "f 1 2 3\n", 1},
             {"\n   \n \r\n  # indented\nf 1// 2/ 3\nfo 1/9\n", "", 0}}) {
        std::vector<std::uint8_t> bytes(c.text.begin(), c.text.end());
        std::size_t faces = 0;
        EXPECT_EQ(mendObjLines(bytes, faces), !c.mended.empty()) << c.text;
        EXPECT_EQ(std::string(bytes.begin(), bytes.end()), c.mended.empty() ? c.text : c.mended);
        EXPECT_EQ(faces, c.faces) << c.text;
    }
}

// A face without texture coordinates does not affect those of other faces.
TEST(AwkwardScene, ObjFacesLoseCoordinatesThatAreNotThere) {
    const TempFolder folder;
    const Result<RawScene> raw =
        readModel(folder.write("room.obj",
                               "v 0 0 0\nv 1 0 0\nv 0 1 0\n  v 0 0 1\nvt 0.25 0.75\nvt 0.5 0.5\n"
                               "f\t1/1 2/2 3/1\n  f 1/1 2/2 4/1\nf 1/-1 3/-2 4/-7\n"),
                  {});
    ASSERT_TRUE(raw) << describe(raw.error());
    std::size_t triangles = 0;
    bool placed = false;
    for (const MeshPart& part : raw->parts) {
        triangles += part.triangles.size();
        placed = placed || std::ranges::any_of(part.uvs, [](const Eigen::Vector2f& uv) {
                     return uv.isApprox(Eigen::Vector2f(0.25F, 0.75F));
                 });
    }
    EXPECT_EQ(triangles, 3U);
    EXPECT_TRUE(placed);
    EXPECT_TRUE(says(raw->notes, "1 face names texture coordinates that are not in the file"));
}

TEST(AwkwardScene, ColladaColoursMayBeginWithBlanks) {
    const TempFolder folder;
    for (const char* color : {"<color>1 0 0 1</color>", "<color>\r\n \t1 0 0 1</color>",
                              "<color sid=\"d\"> 1 0 0 1</color>"}) {
        const Result<RawScene> raw =
            readModel(folder.write("red.dae",
                                   R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert><diffuse>)" +
                                       std::string(color) + R"(</diffuse></lambert></technique>
</profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="9">
0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#a" count="3" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/>
</vertices><triangles count="1" material="k"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="k" target="#m"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)"),
                      {});
        ASSERT_TRUE(raw) << color << describe(raw.error());
        ASSERT_EQ(raw->parts.size(), 1U);
        EXPECT_EQ(raw->materials.at(raw->parts[0].material).base_color, Eigen::Vector3f(1, 0, 0))
            << color;
    }
}

/// A Collada file whose geometries, axis-aligned boxes with the z axis up, are all in one node.
std::string colladaInOneNode(const std::vector<Eigen::AlignedBox3d>& boxes) {
    std::ostringstream geometries;
    std::ostringstream instances;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        geometries << "<geometry id=\"ID" << i << "\"><mesh><source id=\"p" << i
                   << "\"><float_array id=\"a" << i << "\" count=\"24\">";
        for (int corner = 0; corner < 8; ++corner) {
            const auto type = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
            geometries << boxes[i].corner(type).transpose() << " ";
        }
        geometries
            << "</float_array><technique_common><accessor source=\"#a" << i
            << "\" count=\"8\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" "
               "type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common>"
               "</source><vertices id=\"v"
            << i << "\"><input semantic=\"POSITION\" source=\"#p" << i
            << "\"/></vertices><triangles count=\"12\"><input semantic=\"VERTEX\" source=\"#v" << i
            << "\" offset=\"0\"/><p>0 2 1 1 2 3 4 5 6 5 7 6 0 1 4 1 5 4 2 6 3 3 6 7 0 4 2 2 4 6 1 "
               "3 5 "
               "3 7 5</p></triangles></mesh></geometry>";
        instances << "<instance_geometry url=\"#ID" << i << "\"/>";
    }
    return "<?xml version=\"1.0\"?><COLLADA "
           "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
           "version=\"1.4.1\"><asset><authoring_tool>SketchUp 14.0</authoring_tool>"
           "<unit name=\"meter\" meter=\"1\"/><up_axis>Z_UP</up_axis></asset><library_geometries>" +
           geometries.str() +
           "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node id=\"n\">" +
           instances.str() +
           "</node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
           "url=\"#s\"/></scene></COLLADA>";
}

TEST(AwkwardScene, TheGeometriesOfARoomInOneNodeAreObjects) {
    using Box = Eigen::AlignedBox3d;
    std::vector<Box> boxes = {Box(Vector3d(0, 0, -0.1), Vector3d(5, 4, 0)),
                              Box(Vector3d(-0.1, 0, 0), Vector3d(0, 4, 2.6)),
                              Box(Vector3d(5, 0, 0), Vector3d(5.1, 4, 2.6)),
                              Box(Vector3d(0, -0.1, 0), Vector3d(5, 0, 2.6)),
                              Box(Vector3d(0, 4, 0), Vector3d(5, 4.1, 2.6)),
                              // It has a corner in common with three walls' corners.
                              Box(Vector3d(0, 0, 0), Vector3d(1.8, 0.6, 2.2))};
    for (int i = 0; i < 16; ++i) {
        const Vector3d low(0.5 + 0.9 * (i % 4), 1.2 + 0.6 * (i / 4), 0.0);
        boxes.emplace_back(low, low + Vector3d(0.3, 0.25, 0.3 + 0.04 * i));
    }
    const Scene scene = importedText(colladaInOneNode(boxes), "room.dae");
    EXPECT_EQ(countTargets(scene), 17);
    test::expectBox(scene, "ID5", {0, 0, 0}, {1.8, 0.6, 2.2});
    EXPECT_FALSE(says(scene.report.warnings, "does not separate"));
}

TEST(AwkwardScene, AMattressAndCushionsAreNotTheFloor) {
    const auto isFloor = [](const Scene& scene, const std::string& name) {
        const Object* found = test::find(scene, name);
        return found != nullptr && found->structure && found->nyu40 == kNyuFloor;
    };
    ObjWriter alone = furnished();
    alone.object("q1").box({2.5, 0.3, 0.36}, {4.4, 1.8, 0.56});
    EXPECT_TRUE(isFloor(importedText(alone.text()), "q1")) << "a platform";
    ObjWriter held = furnished();
    held.object("q1").box({2.5, 0.3, 0.36}, {4.4, 1.8, 0.56});
    held.object("q2").box({2.4, 0.2, 0.0}, {2.5, 1.9, 0.9}).box({4.4, 0.2, 0.0}, {4.5, 1.9, 0.5});
    held.box({2.4, 0.2, 0.2}, {4.5, 0.3, 0.4});  // joins the ends of the bed
    EXPECT_FALSE(isFloor(importedText(held.text()), "q1"));
    ObjWriter cushions = furnished();
    cushions.object("q1");
    for (const double x : {2.4, 4.2}) {
        for (const double y : {0.3, 1.6}) cushions.box({x, y, 0.4}, {x + 0.4, y + 0.4, 0.5});
    }
    EXPECT_FALSE(isFloor(importedText(cushions.text()), "q1"));
}

/// A shell with outward faces still encloses the room.
TEST(AwkwardScene, AnInsideOutShellIsARoom) {
    const Scene as_it_is = importedText(furnished().text());
    // All faces have reversed winding.
    std::string turned;
    std::istringstream lines(furnished().text());
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("f ")) {
            turned += line + "\n";
            continue;
        }
        std::istringstream words(line.substr(2));
        std::string corners;
        for (std::string word; words >> word;) corners.insert(0, " " + word);
        turned += "f" + corners + "\n";
    }
    const TempFolder folder;
    const Result<Scene> scene = importScene(folder.write("room.obj", turned));
    ASSERT_TRUE(scene) << describe(scene.error());
    EXPECT_EQ(countTargets(*scene), countTargets(as_it_is));
    EXPECT_TRUE(scene->room_bounds.isApprox(as_it_is.room_bounds, 1e-6));
    EXPECT_EQ(scene->report.up_axis, as_it_is.report.up_axis);
}

TEST(AwkwardScene, ADomeIsNoRoom) {
    ObjWriter obj = furnished();
    obj.object("dome").box({-100, -100, -100}, {100, 100, 100});
    const Scene scene = importedText(obj.text());
    EXPECT_NEAR(scene.room_bounds.sizes().x(), 5.0, 1e-3);
    EXPECT_EQ(countTargets(scene), 4);
}

// Each wall of a room 3 x 3 x 2.5 m whose corner is 20 m away, with a table in it.
ObjWriter withDistantRoom(int walls, bool table) {
    ObjWriter obj = furnished();
    obj.object("kitchen_floor").box({20, 0, -0.1}, {23, 3, 0});
    const Eigen::Vector3d lows[] = {{20, 0, 0}, {20, 0, 0}, {22.9, 0, 0}, {20, 2.9, 0}};
    const Eigen::Vector3d highs[] = {{20.1, 3, 2.5}, {23, 0.1, 2.5}, {23, 3, 2.5}, {23, 3, 2.5}};
    for (int i = 0; i < walls; ++i) {
        obj.object("kitchen_wall_" + std::to_string(i)).box(lows[i], highs[i]);
    }
    if (table) obj.object("kitchen_table").box({21, 1, 0}, {22, 2, 0.75});
    return obj;
}

TEST(AwkwardScene, RoomsFarFromEachOtherCount) {
    for (const int walls : {3, 4}) {
        const Scene scene = importedText(withDistantRoom(walls, true).text());
        EXPECT_NEAR(scene.room_bounds.max().x(), 23.0, 1e-3) << walls;
        EXPECT_EQ(countTargets(scene), 5);
        EXPECT_FALSE(says(scene.report.notes, "outside or around the building"));
    }
}

TEST(AwkwardScene, DistantObjectsWithoutARoomDoNotCount) {
    // Two walls and a closed box without furniture are no rooms.
    for (const auto& [walls, table] : {std::pair(2, true), std::pair(4, false)}) {
        const Scene scene = importedText(withDistantRoom(walls, table).text());
        EXPECT_NEAR(scene.room_bounds.sizes().x(), 5.0, 1e-3) << walls;
        EXPECT_TRUE(says(scene.report.notes, "outside or around the building"));
    }
}

TEST(AwkwardScene, UnknownLinesOfMaterialsAreIgnored) {
    const std::string text =
        "newmtl wood\n\tKd 0.5 0.25 0.125\n\tanisotropicRotation 0\n\tao 1\r\n\tKs 0\n"
        "d -halo 0.5\naniso 0\nKe spectral file.rfl\nPr 0.5\nmap_Kd wood.ppm\n";
    std::vector<std::uint8_t> bytes(text.begin(), text.end());
    EXPECT_TRUE(dropUnknownMaterialLines(bytes));
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()),
              "newmtl wood\n\tKd 0.5 0.25 0.125\n#anisotropicRotation 0\n#ao 1\r\n\tKs 0\n"
              "# -halo 0.5\n#niso 0\n#e spectral file.rfl\nPr 0.5\nmap_Kd wood.ppm\n");
    const TempFolder folder;
    static_cast<void>(folder.write("room.mtl", text));
    const Result<RawScene> raw =
        readModel(folder.write("room.obj",
                               "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\n"
                               "f 1 2 3\n"),
                  {});
    ASSERT_TRUE(raw) << describe(raw.error());
    EXPECT_TRUE(std::ranges::any_of(
        raw->materials, [](const Material& material) { return material.name == "wood"; }));
}

TEST(AwkwardScene, OfTexturesWithOneNameThatOfTheSameFolderIsUsed) {
    const TempFolder folder;
    for (const std::string place : {"2", "deep/TV", "A"}) {
        std::filesystem::create_directories(folder.path() / place);
        static_cast<void>(
            folder.write(place + "/images.ppm",
                         "P6\n1 1\n255\n" + place.substr(0, 1) + place.substr(0, 1) + "0"));
    }
    static_cast<void>(folder.write("room.mtl",
                                   "newmtl tv\nmap_Kd C:\\work\\tv\\images.ppm\n"
                                   "newmtl wood\nmap_Kd C:\\work\\A\\images.ppm\n"));
    ObjWriter obj;
    obj.object("tv").material("tv").box({0, 0, 0}, {1, 1, 1});
    obj.object("table").material("wood").box({2, 0, 0}, {3, 1, 1});
    const Scene scene = test::imported(folder.write("room.obj", "mtllib room.mtl\n" + obj.text()));
    for (const auto& [name, red] : {std::pair("tv", 'd'), std::pair("wood", 'A')}) {
        const auto found = std::ranges::find(scene.materials, name, &Material::name);
        ASSERT_NE(found, scene.materials.end()) << name;
        ASSERT_GE(found->texture, 0);
        const Texture& texture = scene.textures[static_cast<std::size_t>(found->texture)];
        ASSERT_FALSE(texture.rgba.empty());
        EXPECT_EQ(texture.rgba[0], red) << name;
    }
}

// From a point in a crown or a car, surfaces stand all round.
TEST(AwkwardScene, TreesAndCarsFarFromTheHouseDoNotCount) {
    ObjWriter tree = furnished();
    tree.object("trunk").box({19.7, 1.7, 0}, {20.3, 2.3, 3});
    tree.object("crown").box({17, -1, 3}, {23, 5, 8});
    tree.object("nest").box({19.8, 1.8, 5}, {20.2, 2.2, 5.3});
    ObjWriter car = furnished();
    car.object("body").box({20, 0, 0.3}, {24.5, 1.9, 1.6});
    car.object("seat").box({21, 0.5, 0.5}, {21.5, 1.0, 1.2});
    car.object("wheel").box({20.5, 0, 0}, {21.1, 0.2, 0.6});
    for (const ObjWriter* obj : {&tree, &car}) {
        EXPECT_NEAR(importedText(obj->text()).room_bounds.sizes().x(), 5.0, 1e-3);
    }
}

}  // namespace
}  // namespace dollytrack::awkward_scene_test
