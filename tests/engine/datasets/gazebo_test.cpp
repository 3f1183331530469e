#include "engine/io/files/reachable_files.h"
#include "engine/io/gazebo/link_xml.h"
#include "engine/scene/labels.h"
#include "tests/engine/datasets/gazebo_worlds.h"
#include "tests/engine/datasets/tiny_datasets.h"
#include "tests/support/imported_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::gazebo_test {
namespace {

using Eigen::Vector3d;
using test::expectBox;
using test::find;
using test::imported;
using test::modelAt;
using test::says;
using test::TempFolder;
using test::world;
using test::writeSofa;

// The L is 2 x 0.5 x 2, x from -1 to 1, y from 0 to 0.5, z from -0.5 to 1.5; here y is doubled.
TEST(Gazebo, PlacesIncludedModelsAndShapes) {
    const TempFolder folder;
    writeSofa(folder, "models");
    const Scene scene = imported(folder.write("worlds/room.world", world(R"(
 <include><uri>model://sofa</uri><name>couch</name><pose>5 0 0 0 0 1.5707963267948966</pose></include>
 <model name="sofa_1"><include><uri>model://sofa/</uri></include><pose degrees="true">0 7 0 0 0 90</pose></model>
 <model name="house"><static>1</static>
  <link name="floor"><visual name="v"><geometry><box><size>20 20 0.2</size></box></geometry>
   <material><diffuse>1 0 0 1</diffuse></material></visual></link>
  <frame name="corner"><pose>1 2 3 0 0 0</pose></frame>
  <link name="column"><pose relative_to="corner">1 0 0 0 0 0</pose><visual name="v"><geometry>
   <cylinder><radius>0.5</radius><length>2</length></cylinder></geometry></visual></link>
  <link name="ball"><pose relative_to="column">0 0 2 0 0 0</pose><visual name="v"><geometry>
   <sphere><radius>0.25</radius></sphere></geometry></visual></link></model>
 <model name="cabinet"><link name="body"><visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual></link>
  <link name="door"><pose>0 -0.55 0 0 0 0</pose><visual name="v"><geometry><box><size>1 0.1 1</size></box></geometry></visual></link>
  <joint name="hinge" type="revolute"><parent>body</parent><child>door</child></joint></model>
 <include><uri>model://lamp</uri></include>)")));
    // An <include> without a pose keeps the model's.
    expectBox(scene, "couch", {4.0, -1.0, 0.5}, {5.0, 1.0, 2.5});
    expectBox(scene, "sofa_1", {-1.0, 6.0, 10.5}, {0.0, 8.0, 12.5});
    expectBox(scene, "floor", {-10, -10, -0.1}, {10, 10, 0.1});
    EXPECT_EQ(find(scene, "floor")->nyu40, kNyuFloor);
    expectBox(scene, "column", {1.5, 1.5, 2.0}, {2.5, 2.5, 4.0});
    expectBox(scene, "ball", {1.75, 1.75, 4.75}, {2.25, 2.25, 5.25});
    expectBox(scene, "cabinet", {-0.5, -0.6, -0.5}, {0.5, 0.5, 0.5});
    EXPECT_EQ(find(scene, "door"), nullptr) << "a joint holds it to the cabinet";
    EXPECT_TRUE(says(scene.report.warnings, "model://lamp"));
    const Object* floor = find(scene, "floor");
    const Material& red = scene.materials[scene.triangle_material[floor->first_triangle]];
    EXPECT_TRUE(red.base_color.isApprox(Eigen::Vector3f(1, 0, 0)));
}

TEST(Gazebo, ModelsComeFromTheFoldersThatAreGiven) {
    const TempFolder folder;
    writeSofa(folder, "elsewhere/shared");
    const auto path =
        folder.write("here/room.sdf", world("<include><uri>model://sofa</uri></include>"));
    const Result<Scene> alone = importScene(path);
    ASSERT_FALSE(alone);
    EXPECT_NE(alone.error().message.find("model://sofa"), std::string::npos);
    const Scene scene = imported(path, {.model_folders = {folder.path() / "elsewhere/shared"}});
    expectBox(scene, "sofa", {-1, 0, 10.5}, {1, 1, 12.5});
    // A model's file is also a scene and finds its own files.
    EXPECT_NE(find(imported(folder.path() / "elsewhere/shared/sofa/model.sdf"), "sofa"), nullptr);
}

// Frames, nested models, included models and a joint, with names that contain "::".
TEST(Gazebo, PosesAreRelativeToNestedFrames) {
    const TempFolder folder;
    writeSofa(folder, "models");
    const std::string box =
        "<visual name='v'><geometry><box><size>1 1 1</size></box></geometry></visual>";
    const Scene scene = imported(folder.write("room.world", world(R"(
 <model name="arm"><pose>0 0 5 0 0 0</pose>
  <link name="base">)" + box + R"(</link>
  <link name="far"><pose relative_to="grip::tool::tip">0 0 1 0 0 0</pose>)" +
                                                                  box + R"(</link>
  <model name="grip"><pose degrees="1">10 0 0 0 0 90</pose>
   <link name="palm">)" + box + R"(</link>
   <model name="tool"><frame name="tip"><pose>2 0 0 0 0 0</pose></frame></model></model>
  <joint name="wrist" type="fixed"><parent>base</parent><child>grip::palm</child></joint></model>
 <model name="shelf" placement_frame="top"><pose>0 20 3 0 0 0</pose>
  <frame name="top"><pose>0 0 2 0 0 0</pose></frame>
  <link name="board"><visual name="v"><pose relative_to="top">0 0 1 0 0 0</pose><geometry>
   <box><size>1 1 1</size></box></geometry></visual></link></model>
 <include><uri>model://sofa</uri><name>couch</name><placement_frame>link</placement_frame>
  <pose>0 30 0 0 0 0</pose></include>
 <model name="cup"><pose relative_to="couch::link">0 0 4 0 0 0</pose><link name="l">)" +
                                                                  box + R"(</link></model>)")));
    // The joint `wrist` connects the base with the palm, which is rotated, at x = 10.
    expectBox(scene, "arm::base", {-0.5, -0.5, 4.5}, {10.5, 0.5, 5.5});
    EXPECT_EQ(find(scene, "palm"), nullptr);
    expectBox(scene, "far", {9.5, 1.5, 5.5}, {10.5, 2.5, 6.5});
    // The shelf's top is at its pose, and the board's visual is 1 m above.
    expectBox(scene, "shelf", {-0.5, 19.5, 3.5}, {0.5, 20.5, 4.5});
    expectBox(scene, "couch", {-1, 30, -0.5}, {1, 31, 1.5});
    expectBox(scene, "cup", {-0.5, 29.5, 3.5}, {0.5, 30.5, 4.5});
}

// <state> has the saved world poses of models and links; the initial poses stay in the models.
TEST(Gazebo, SavedWorldUsesThePosesOfItsState) {
    const TempFolder folder;
    writeSofa(folder, "models");
    const std::string box =
        R"(<visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual>)";
    const std::string models = R"(
 <include><uri>model://sofa</uri><name>couch</name><pose>0 30 0 0 0 0</pose></include>
 <model name="cabinet"><pose>1 0 0 0 0 0</pose><link name="body">)" +
                               box + R"(</link>
  <link name="door"><pose>0 1 0 0 0 0</pose>)" +
                               box + R"(</link></model>
 <model name="cup"><pose relative_to="couch">3 0 0 0 0 0</pose><link name="l">)" +
                               box + R"(</link></model>
 <model name="nest"><model name="egg"><link name="l">)" +
                               box + R"(</link></model></model>)";
    const std::string state = R"(<state world_name="w"><sim_time>1 0</sim_time>
 <model name="couch"><pose frame=''>0 40 0 0 0 0</pose><scale>1 1 1</scale></model>
 <model name="cabinet"><pose>0 0 10 0 0 0</pose><scale>2 1 1</scale>
  <link name="body"><pose>0 0 10 0 0 0</pose></link>
  <link name="door"><pose>0 5 10 0 0 1.5707963267948966</pose></link></model>
 <model name="nest"><pose>0 0 20 0 0 0</pose><model name="egg"><pose>0 0 21 0 0 0</pose></model>
 </model>
 <model name="gone"><pose>9 9 9 0 0 0</pose></model></state>)";
    const Scene scene = imported(folder.write("saved.world", world(models + state)));
    expectBox(scene, "couch", {-1, 40, 0.5}, {1, 41, 2.5});
    expectBox(scene, "cabinet::body", {-0.5, -0.5, 9.5}, {0.5, 0.5, 10.5});
    EXPECT_TRUE(says(scene.report.warnings, "the saved scale of the model 'cabinet'"));
    expectBox(scene, "door", {-0.5, 4.5, 9.5}, {0.5, 5.5, 10.5});
    // Without a state of its own it stays where the loaded couch put it.
    expectBox(scene, "cup", {2.5, 29.5, -0.5}, {3.5, 30.5, 0.5});
    expectBox(scene, "nest", {-0.5, -0.5, 20.5}, {0.5, 0.5, 21.5});
    // Without <state>, everything is where it started.
    const Scene started = imported(folder.write("started.world", world(models)));
    expectBox(started, "couch", {-1, 30, 0.5}, {1, 31, 2.5});
    // There, the cabinet's body and door touch each other.
    expectBox(started, "cabinet", {0.5, -0.5, -0.5}, {1.5, 1.5, 0.5});
    // A malformed pose is an error with its line.
    const auto bad = importScene(folder.write(
        "bad.world",
        world(models + R"(<state><model name="cup"><pose>1 2</pose></model></state>)")));
    ASSERT_FALSE(bad);
    EXPECT_NE(bad.error().message.find("the state of 'cup'"), std::string::npos)
        << bad.error().message;
    EXPECT_NE(bad.error().where.find("bad.world:"), std::string::npos) << bad.error().where;
}

TEST(Gazebo, NestedModelsKeepTheirNames) {
    const TempFolder folder;
    writeSofa(folder, "models");
    const Scene scene = imported(folder.write("room.world", world(R"(<model name="corner">
 <include><uri>model://sofa</uri></include>
 <model name="stool"><pose>5 0 0 0 0 0</pose><link name="l"><visual name="v"><geometry>
  <sphere><radius>1</radius></sphere></geometry></visual></link></model></model>)")));
    EXPECT_NE(find(scene, "sofa"), nullptr);
    EXPECT_NE(find(scene, "stool"), nullptr);
}

// Parts "seat" (a box at x = 4) and "back" (at x = 10).
TEST(Gazebo, SubmeshesAreCentredOrMissed) {
    const TempFolder folder;
    const auto box = [](const std::string& name, int first, double x) {
        std::string text = "o " + name + "\n";
        for (int i = 0; i < 8; ++i) {
            text += "v " + std::to_string(x + (i & 1)) + " " + std::to_string(i >> 1 & 1) + " " +
                    std::to_string(i >> 2) + "\n";
        }
        for (const auto& face : {std::array{1, 3, 4, 2},
                                 {5, 6, 8, 7},
                                 {1, 2, 6, 5},
                                 {3, 7, 8, 4},
                                 {1, 5, 7, 3},
                                 {2, 4, 8, 6}}) {
            text += "f";
            for (const int corner : face) text += fmt::format(" {}", corner + first);
            text += "\n";
        }
        return text;
    };
    static_cast<void>(folder.write("chair.obj", box("seat", 0, 4.0) + box("back", 8, 10.0)));
    const auto model = [](const std::string& name, const std::string& submesh) {
        return "<model name='" + name +
               "'><link name='l'><visual name='v'><geometry><mesh><uri> "
               "chair.obj </uri><submesh>" +
               submesh + "</submesh></mesh></geometry></visual></link></model>";
    };
    const Scene scene = imported(folder.write(
        "room.world", world(model("placed", "<name>seat</name>") +
                            model("centred", "<name>back</name><center>true</center>") +
                            model("none", "<name>leg</name>"))));
    expectBox(scene, "placed", {4, 0, 0}, {5, 1, 1});
    expectBox(scene, "centred", {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    EXPECT_EQ(find(scene, "none"), nullptr);
    EXPECT_TRUE(says(scene.report.warnings, "chair.obj: leg"));
}

// 0.5 in sRGB is 0.2140 in linear light, whatever program converts it.
TEST(Gazebo, ColoursStayWithTheirVisual) {
    const TempFolder folder;
    static_cast<void>(folder.write("l.obj", test::lShapedModel()));
    int placed = 0;  // separate, because a mesh twice at one position counts once
    const auto model = [&](const std::string& name, const std::string& material) {
        return "<model name='" + name + "'><pose>" + std::to_string(5 * placed++) +
               " 0 0 0 0 0</pose><link name='l'><visual name='v'><geometry><mesh><uri>"
               "l.obj</uri></mesh></geometry>" +
               material + "</visual></link></model>";
    };
    const std::string grey = "<material><diffuse>0.5 0.5 +0.5 1</diffuse></material>";
    const Scene scene = imported(
        folder.write("room.world", world(model("plain", "") + model("grey", grey) +
                                         model("grey_too", grey) + model("plain_too", ""))));
    const auto materialOf = [&](const std::string& name) {
        const Object* object = find(scene, name);
        return object == nullptr ? 0U : scene.triangle_material[object->first_triangle];
    };
    EXPECT_EQ(materialOf("plain"), materialOf("plain_too"));
    EXPECT_EQ(materialOf("grey"), materialOf("grey_too"));
    ASSERT_NE(materialOf("plain"), materialOf("grey"));
    const Eigen::Vector3f color = scene.materials[materialOf("grey")].base_color;
    EXPECT_LT((color - Eigen::Vector3f::Constant(0.2140F)).norm(), 1e-3F) << color.transpose();
    const Eigen::Vector3f plain = scene.materials[materialOf("plain")].base_color;
    EXPECT_GT((plain - color).norm(), 1e-3F) << plain.transpose();
}

// Two textures with the same name: the mesh's path determines which one is used. Each file is one
// texture, however many meshes use it.
TEST(Gazebo, TexturesLieBesideTheMeshesOrAroundThem) {
    const TempFolder folder;
    const std::string head = "P6\n1 1\n255\n";
    static_cast<void>(
        folder.write("models/m/meshes/map.ppm", head + "\xFF" + std::string(2, '\0')));
    static_cast<void>(
        folder.write("models/m/materials/textures/map.ppm", head + std::string(2, '\0') + "\xFF"));
    std::string links;
    for (const auto& [name, map] :
         {std::pair("red", "map.ppm"), std::pair("blue", "../materials/textures/map.ppm"),
          std::pair("orange", "map.ppm")}) {
        const std::string mesh = "models/m/meshes/" + std::string(name);
        static_cast<void>(
            folder.write(mesh + ".mtl", "newmtl m\nmap_Kd " + std::string(map) + "\n"));
        static_cast<void>(folder.write(
            mesh + ".obj", "mtllib " + std::string(name) +
                               ".mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                               "f 1/1 2/2 3/3\n"));
        links += "<link name='" + std::string(name) + "'><pose>" + std::to_string(links.size()) +
                 " 0 0 0 0 0</pose><visual name='v'><geometry><mesh><uri>"
                 "model://m/meshes/" +
                 name + ".obj</uri></mesh></geometry></visual></link>";
    }
    const Scene scene =
        imported(folder.write("room.world", world("<model name='m'>" + links + "</model>")));
    EXPECT_TRUE(scene.report.textures_missing.empty());
    EXPECT_EQ(scene.report.textures_found, 2);
    for (const auto& [name, channel] :
         {std::pair("red", 0U), std::pair("blue", 2U), std::pair("orange", 0U)}) {
        const Object* object = find(scene, name);
        ASSERT_NE(object, nullptr) << name;
        const int texture =
            scene.materials[scene.triangle_material[object->first_triangle]].texture;
        ASSERT_GE(texture, 0) << name;
        const auto& rgba = scene.textures[texture].rgba;
        ASSERT_GE(rgba.size(), 4U) << name;
        EXPECT_EQ(rgba[channel], 255) << name;
        EXPECT_EQ(rgba[2U - channel], 0) << name;
    }
}

// Meshes with the same file name in different models are different.
TEST(Gazebo, ModelsDoNotTakeFilesOfOthers) {
    const TempFolder folder;
    writeSofa(folder, "models");
    static_cast<void>(folder.write("models/lamp/meshes/l.obj", test::lShapedModel()));
    static_cast<void>(
        folder.write("models/lamp/model.sdf", R"(<sdf version="1.6"><model name="lamp">
 <link name="own"><visual name="v"><geometry><mesh><uri>model://lamp/meshes/l.obj</uri></mesh></geometry></visual></link>
 <link name="other"><visual name="v"><geometry><mesh><uri>model://desk/meshes/l.obj</uri></mesh></geometry></visual></link>
</model></sdf>)"));
    const Scene scene = imported(folder.path() / "models/lamp/model.sdf");
    EXPECT_EQ(scene.objects.size(), 1U);
    EXPECT_TRUE(says(scene.report.warnings, "model://desk/meshes/l.obj"));
}

TEST(Gazebo, LightsThatAreIncludedAreLeftOut) {
    const TempFolder folder;
    writeSofa(folder, "models");
    static_cast<void>(folder.write("models/sun/model.sdf",
                                   "<sdf version='1.6'><light name='sun' type='point'/></sdf>"));
    const Scene scene = imported(
        folder.write("room.world", world("<include><uri>model://sun</uri></"
                                         "include><include><uri>model://sofa</uri></include>")));
    EXPECT_EQ(scene.objects.size(), 1U);
}

TEST(Gazebo, GazebosOwnSunAndGroundPlaneNeedNoFiles) {
    const TempFolder folder;
    writeSofa(folder, "models");
    const std::string fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
    for (const auto& [sun, ground] :
         {std::pair<std::string, std::string>{"model://sun", "model://ground_plane"},
          {fuel + "Sun", fuel + "Ground Plane"}}) {
        const Scene scene = imported(folder.write(
            "room.world", world("<include><uri>" + sun + "</uri></include><include><uri>" + ground +
                                "</uri><pose>1 2 -0.5 0 0 0</pose></include>"
                                "<include><uri>model://sofa</uri></include>"
                                "<include><uri>model://moon</uri></include>")));
        ASSERT_EQ(scene.objects.size(), 2U);
        const Object& plane = scene.objects.front();
        EXPECT_EQ(plane.name, "ground_plane");
        for (std::uint32_t v = 0; v < plane.vertex_count; ++v) {
            const Eigen::Vector3f& at = scene.positions[plane.first_vertex + v];
            EXPECT_NEAR(std::abs(at.x() - 1.0F), 50.0F, 1e-4F);
            EXPECT_NEAR(std::abs(at.y() - 2.0F), 50.0F, 1e-4F);
            EXPECT_NEAR(at.z(), -0.5F, 1e-6F);
        }
        EXPECT_FALSE(says(scene.report.warnings, sun));
        EXPECT_FALSE(says(scene.report.warnings, ground));
        EXPECT_TRUE(says(scene.report.warnings, "model://moon"));
    }
}

/// A <population> of spheres named "ball" with the diameter 2.
std::string population(const std::string& name, const std::string& others) {
    return "<population name='" + name + "'><model name='ball'><pose>9 9 9 0 0 0</pose>" +
           "<link name='l'>" + test::kBall + "</link></model>" + others + "</population>";
}

// The expected positions follow Gazebo Classic's Population::CreatePosesBoxGrid and its relatives.
TEST(Gazebo, PopulationsAreGridsAndRowsOfModels) {
    const TempFolder folder;
    writeSofa(folder, "models");
    const auto expectBalls = [&](const std::string& others, const std::vector<Vector3d>& centres) {
        const Scene scene = imported(folder.write("room.world", world(population("p", others))));
        ASSERT_EQ(scene.objects.size(), centres.size()) << others;
        EXPECT_TRUE(scene.report.warnings.empty());
        for (std::size_t i = 0; i < centres.size(); ++i) {
            expectBox(scene, fmt::format("ball_clone_{}", i), centres[i].array() - 1.0,
                      centres[i].array() + 1.0);
        }
    };
    const std::string grid =
        "<distribution><type>grid</type><rows>2</rows><cols>3</cols>"
        "<step>3 4 7</step></distribution>";
    expectBalls("<pose>10 20 30 0 0 0</pose>" + grid,
                {{7, 18, 30}, {10, 18, 30}, {13, 18, 30}, {7, 22, 30}, {10, 22, 30}, {13, 22, 30}});
    // A quarter turn maps the steps along x to y, but not the way to the first model.
    expectBalls("<pose>10 20 30 0 0 1.5707963267948966</pose>" + grid,
                {{7, 18, 30}, {7, 21, 30}, {7, 24, 30}, {3, 18, 30}, {3, 21, 30}, {3, 24, 30}});
    const std::string box = "<model_count>3</model_count><box><size>6 8 12</size></box>";
    const auto row = [&](const std::string& type) {
        return "<pose>1 2 3 0 0 0</pose>" + box + "<distribution><type>" + type +
               "</type></distribution>";
    };
    expectBalls(row("linear-x"), {{-2, 2, 3}, {0, 2, 3}, {2, 2, 3}});
    expectBalls(row("linear-y"), {{1, -2, 3}, {1, -2 + 8.0 / 3, 3}, {1, -2 + 16.0 / 3, 3}});
    expectBalls(row("linear-z"), {{1, 2, -3}, {1, 2, 1}, {1, 2, 5}});

    // A model that includes another, as worlds mostly have.
    const Scene sofas = imported(folder.write(
        "room.world",
        world("<population name='p'><model name='couch'><include><uri>model://sofa</uri>"
              "<pose>0 0 0 0 0 0</pose></include></model><pose>0 0 1 0 0 0</pose><distribution>"
              "<type>grid</type><rows>1</rows><cols>2</cols><step>4 0 0</step></distribution>"
              "</population>")));
    ASSERT_EQ(sofas.objects.size(), 2U);
    expectBox(sofas, "couch_clone_0", {-3, 0, 1.5}, {-1, 1, 3.5});
    expectBox(sofas, "couch_clone_1", {1, 0, 1.5}, {3, 1, 3.5});
}

TEST(Gazebo, PopulationsWithoutFixedPositionsAreNamed) {
    const TempFolder folder;
    const auto place = [](const std::string& distribution) {
        return "<pose>0 0 0 0 0 0</pose><model_count>5</model_count><box><size>1 1 1</size></box>"
               "<distribution>" +
               distribution + "</distribution>";
    };
    const auto grid = [](int rows) {
        return fmt::format("<type>grid</type><rows>{}</rows><cols>7</cols><step>1 1 0</step>",
                           rows);
    };
    const Scene scene = imported(folder.write(
        "room.world",
        world(std::string("\n") + modelAt(0, "table", test::kBall) +
              population("cans", place("<type>random</type>")) +
              population("cups", place("<type>uniform</type>")) +
              population("books", place("<type>grid</type><rows>2</rows>")) +
              population("none", place(grid(0))) + population("many", place(grid(100'000))))));
    EXPECT_EQ(scene.objects.size(), 1U);
    const auto& warnings = scene.report.warnings;
    EXPECT_EQ(warnings.size(), 5U);
    EXPECT_TRUE(says(warnings,
                     "room.world:2: the population 'cans' is left out, since the positions of its "
                     "models are random"));
    EXPECT_TRUE(says(warnings, "'cups' is left out, since the positions of its models are random"));
    EXPECT_TRUE(says(warnings, "'books' is left out, since its <model>, <pose> or <distribution>"));
    EXPECT_TRUE(says(warnings, "'none' is left out, since its"));
    EXPECT_TRUE(says(warnings, "'many' is left out, since it has more than 20000 models"));
}

/// A model "kitchen" of links with meaningless names: a floor, four walls and a table of boxes.
std::string kitchen(double scale) {
    std::string text;
    int number = 0;
    const auto add = [&](const Vector3d& low, const Vector3d& high) {
        const Vector3d middle = scale * (low + high) / 2;
        const Vector3d size = scale * (high - low);
        text += fmt::format(
            "<model name='part{}.obj'><link name='l{}'><pose>{} {} {} 0 0 0</pose>"
            "<visual name='v'><geometry><box><size>{} {} {}</size></box></geometry>"
            "</visual></link></model>",
            number, number, middle.x(), middle.y(), middle.z(), size.x(), size.y(), size.z());
        ++number;
    };
    add({0, 0, -0.05}, {6, 4, 0});
    add({0, 0, 0}, {6, 0.1, 2.7});
    add({0, 3.9, 0}, {6, 4, 2.7});
    add({0, 0.1, 0}, {0.1, 3.9, 2.7});
    add({5.9, 0.1, 0}, {6, 3.9, 2.7});
    add({1, 1, 0.7}, {2.4, 1.8, 0.75});
    add({3, 2, 0}, {3.6, 2.6, 0.9});
    return text;
}

TEST(Gazebo, ObjectsWithoutTellingNamesAreJudgedByTheirShape) {
    const TempFolder folder;
    const Scene scene = imported(folder.write("kitchen.sdf", world(kitchen(1.0))));
    ASSERT_EQ(scene.objects.size(), 7U);
    EXPECT_EQ(scene.objects[0].nyu40, kNyuFloor);
    for (int i = 1; i < 5; ++i) EXPECT_EQ(scene.objects[i].nyu40, kNyuWall) << i;
    EXPECT_EQ(test::countTargets(scene), 2);
    // The same shapes as a robot of half a metre: its base is no floor.
    EXPECT_EQ(test::countTargets(imported(folder.write("robot.sdf", world(kitchen(0.1))))), 7);
}

// Symbolic links within a folder are allowed, but not those that lead out.
TEST(ReachableFiles, StopAtLinksThatLeadOut) {
    const TempFolder folder;
    const auto secret = folder.write("outside/secret.obj", "v 0 0 0\n");
    const auto own = folder.write("scene/chairs/chair.obj", "v 0 0 0\n").parent_path();
    const auto scene = own.parent_path();
    std::filesystem::create_directory_symlink(secret.parent_path(), scene / "link");
    std::filesystem::create_symlink(secret, scene / "secret.obj");
    const ReachableFiles files({scene});
    EXPECT_TRUE(files.find(scene, "chairs/chair.obj"));
    EXPECT_TRUE(files.find(own, "../chairs/chair.obj"));
    for (const char* name :
         {"link/secret.obj", "secret.obj", "../outside/secret.obj", "/etc/passwd"}) {
        EXPECT_FALSE(files.find(scene, name)) << name;
    }
    EXPECT_TRUE(files.reaches(scene));
    EXPECT_TRUE(files.reaches(own));
    EXPECT_TRUE(files.reaches(own / "chair.obj"));
    for (const auto& path : {scene / "link", scene / "link/secret.obj", scene / "secret.obj",
                             scene / "../outside", scene / "nothing"}) {
        EXPECT_FALSE(files.reaches(path)) << path;
    }
    EXPECT_EQ(files.namesIn(scene).value(), std::vector<std::string>{"chairs"});
    EXPECT_TRUE(files.namesIn(scene / "link").value().empty());
}

TEST(Gazebo, NumbersAreReadAsWritten) {
    const auto numbers = gazebo::numbersOf(" +1.5\t-2e1, 1e-400 1e-310\n");
    ASSERT_TRUE(numbers);
    EXPECT_EQ(*numbers, (std::vector<double>{1.5, -20.0, 0.0, 1e-310}));
    // 1e-396 and 1e395, too small and too large for a double, although their exponents are small.
    const std::string zeros(400, '0');
    EXPECT_EQ(gazebo::numbersOf("0." + zeros + "1e5"), std::vector<double>{0.0});
    EXPECT_EQ(gazebo::numbersOf(zeros + "1e5"), std::vector<double>{1e5});
    EXPECT_FALSE(gazebo::numbersOf("1" + zeros + "e-5"));
    for (const char* text : {"1e400", "nan", "inf", "+-1", "++1", "+", "1.5m", "0x10"}) {
        EXPECT_FALSE(gazebo::numbersOf(text)) << text;
    }
}

// Computed by hand: roll by 90 degrees maps y to z, then yaw by 90 degrees maps x to y.
TEST(Gazebo, AnglesTurnAboutFixedAxes) {
    const Eigen::Quaterniond rotation = gazebo::rotationFromRollPitchYaw({M_PI / 2, 0.0, M_PI / 2});
    EXPECT_LT((rotation * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-12);
    EXPECT_LT((rotation * Vector3d::UnitY() - Vector3d::UnitZ()).norm(), 1e-12);
    EXPECT_LT((rotation * Vector3d::UnitZ() - Vector3d::UnitX()).norm(), 1e-12);
    // Pitch by 90 degrees maps x to -z, which yaw keeps, and z to x, which yaw maps to y.
    const Eigen::Quaterniond other = gazebo::rotationFromRollPitchYaw({0.0, M_PI / 2, M_PI / 2});
    EXPECT_LT((other * Vector3d::UnitX() + Vector3d::UnitZ()).norm(), 1e-12);
    EXPECT_LT((other * Vector3d::UnitZ() - Vector3d::UnitY()).norm(), 1e-12);
}

}  // namespace
}  // namespace dollytrack::gazebo_test
