#include "tests/engine/datasets/gazebo_worlds.h"
#include "tests/support/imported_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

namespace dollytrack::gazebo_faults_test {
namespace {

using test::expectBox;
using test::find;
using test::imported;
using test::kBall;
using test::meshVisual;
using test::modelAt;
using test::says;
using test::TempFolder;
using test::world;

// Each world also has a ball, so that it would be valid without the fault.
TEST(Gazebo, CirclesAndNonsenseAreRefused) {
    const TempFolder folder;
    // a includes itself, b includes c, and c includes b.
    for (const auto& [name, other] : {std::pair("a", "a"), {"b", "c"}, {"c", "b"}}) {
        static_cast<void>(folder.write(
            fmt::format("models/{}/model.sdf", name),
            fmt::format("<sdf version='1.6'><model name='m'><include><uri>model://{}</uri>"
                        "</include></model></sdf>",
                        other)));
    }
    struct Case {
        const char* text;
        const char* message;
    };
    const Case kCases[] = {
        {"<include><uri>model://a</uri></include>", "includes itself"},
        {"<include><uri>model://b</uri></include>", "includes itself"},
        {"<model name='m'><frame name='f'><pose relative_to='g'/></frame><frame name='g'><pose "
         "relative_to='f'/></frame><link name='l'><pose relative_to='f'/></link></model>",
         "relative to itself"},
        {"<model name='m'><pose relative_to='m::l'/><link name='l'/></model>",
         "relative to itself"},
        {"<model name='m'><link name='l'><pose relative_to='n::l'/></link></model>",
         "which does not exist"},
        {"<model name='m'><link name='l'><pose relative_to='l'>0 0 0 0 0 0</pose></link></model>",
         "relative to itself"},
        {"<model name='m'><link name='l'><pose>0 0 nan 0 0 0</pose></link></model>",
         "not six numbers"},
        {"<model name='m'><link name='l'><visual name='v'><geometry><sphere><radius>0</radius>"
         "</sphere></geometry></visual></link></model>",
         "size of a visual of 'l' is 0"}};
    const std::string ball = modelAt(9, "ball", kBall);
    EXPECT_EQ(imported(folder.write("room.world", world(ball))).objects.size(), 1U);
    for (const auto& [text, message] : kCases) {
        const Result<Scene> scene = importScene(folder.write("room.world", world(ball + text)));
        ASSERT_FALSE(scene) << text;
        EXPECT_EQ(scene.error().code, ErrorCode::BadInput) << text;
        EXPECT_NE(scene.error().message.find(message), std::string::npos)
            << text << ": " << scene.error().message;
    }
    const Result<Scene> damaged = importScene(folder.write("cut.world", "<sdf><world name='w'>"));
    ASSERT_FALSE(damaged);
    EXPECT_NE(damaged.error().message.find("damaged or truncated"), std::string::npos);
}

// A path on the author's machine leads to the file whose path ends in the same way.
TEST(Gazebo, AbsolutePathsOfOtherMachinesAreFoundByTheirEnds) {
    const TempFolder folder;
    static_cast<void>(folder.write("repo/meshes/l.obj", test::lShapedModel()));
    static_cast<void>(folder.write("elsewhere/parts/k.obj", test::lShapedModel()));
    const auto worldOf = [&](const std::string& uri) {
        return folder.write("repo/worlds/room.world",
                            world(modelAt(0, "ball", kBall) + modelAt(5, "l", meshVisual(uri))));
    };
    ImportOptions options;
    options.model_folders = {folder.path() / "repo", folder.path() / "elsewhere"};
    for (const char* uri : {"file:///home/author/ws/repo/meshes/l.obj", "/home/author/meshes/l.obj",
                            "file:///home/author/parts/k.obj"}) {
        const auto scene = importScene(worldOf(uri), options);
        ASSERT_TRUE(scene) << uri;
        EXPECT_NE(find(*scene, "l"), nullptr) << uri;
    }
    const auto other = importScene(worldOf("file:///home/author/parts/other.obj"), options);
    ASSERT_TRUE(other);
    EXPECT_EQ(find(*other, "l"), nullptr);
}

TEST(Gazebo, NegativeSizesAreDrawnAsPositiveOnes) {
    const TempFolder folder;
    const Scene scene = imported(folder.write(
        "room.world",
        world(modelAt(0, "box",
                      "<visual name='v'><geometry><box><size>-4 0.2 3</size></box></geometry>"
                      "</visual>"))));
    ASSERT_NE(find(scene, "box"), nullptr);
    EXPECT_TRUE(find(scene, "box")->box.half_size.isApprox(Eigen::Vector3d(2, 0.1, 1.5), 1e-6));
}

// A valid mesh in a folder whose files the world may not use.
TEST(Gazebo, MeshesOutsideAreLeftOut) {
    const TempFolder folder;
    const TempFolder other;
    static_cast<void>(folder.write("outside/l.obj", test::lShapedModel()));
    const auto outside = other.write("elsewhere/l.obj", test::lShapedModel());
    static_cast<void>(folder.write("room/meshes/l.obj", test::lShapedModel()));
    for (const std::string& uri : {std::string("../outside/l.obj"), outside.string(),
                                   fmt::format("file://{}", outside.string())}) {
        const Scene scene =
            imported(folder.write("room/room.world", world(modelAt(0, "ball", kBall) +
                                                           modelAt(5, "l", meshVisual(uri)))));
        EXPECT_EQ(find(scene, "l"), nullptr) << uri;
        EXPECT_TRUE(says(scene.report.warnings, "was not found")) << uri;
    }
    EXPECT_NE(find(imported(folder.write("room/room.world",
                                         world(modelAt(5, "l", meshVisual("meshes/l.obj"))))),
                   "l"),
              nullptr);
}

// The message says which object lacks a mesh, and whether the mesh alone is missing, or its folder.
TEST(Gazebo, TheCauseOfAMissingMeshIsNamed) {
    const TempFolder folder;
    static_cast<void>(folder.write("models/sofa/meshes/sofa.obj", test::lShapedModel()));
    const std::pair<const char*, const char*> kCases[] = {
        {"model://sofa/meshes/Sofa.obj",
         "differs in upper and lower case; rename the file: "
         "model://sofa/meshes/Sofa.obj"},
        {"model://sofa/meshes/leg.obj",
         "copy or download the whole model: "
         "model://sofa/meshes/leg.obj"},
        {"model://table/meshes/table.obj",
         "give the folder around it with --models: "
         "model://table/meshes/table.obj"}};
    for (const auto& [uri, cause] : kCases) {
        const Scene scene =
            imported(folder.write("room.world", world(modelAt(0, "ball", kBall) +
                                                      modelAt(5, "red sofa", meshVisual(uri)))));
        EXPECT_TRUE(says(scene.report.warnings, cause)) << uri;
        EXPECT_TRUE(says(scene.report.warnings,
                         "1 object lacks all of its meshes and is left out: red sofa"))
            << uri;
    }
}

TEST(Gazebo, AnObjectThatLacksSomeOfItsMeshesIsNotCalledMissing) {
    const TempFolder folder;
    const std::string missing = meshVisual("model://none/a.obj");
    const Scene scene = imported(folder.write(
        "room.world", world(modelAt(0, "station", kBall + missing) + modelAt(5, "gone", missing))));
    EXPECT_TRUE(says(scene.report.warnings, "1 object lacks some of its meshes: station (1 of 2)"));
    EXPECT_TRUE(
        says(scene.report.warnings, "1 object lacks all of its meshes and is left out: gone"));
}

TEST(Gazebo, MissingModelsNameTheirIncludes) {
    const TempFolder folder;
    const std::string include = "<include><uri>model://sofa</uri>";
    const Scene scene = imported(
        folder.write("room.world", world(modelAt(0, "ball", kBall) + include +
                                         "<name>red</name></include>" + include + "</include>")));
    EXPECT_TRUE(says(scene.report.warnings, "--models: model://sofa"));
    EXPECT_TRUE(says(scene.report.warnings, "2 names of <include>s that are left out: red, sofa"));
}

TEST(Gazebo, IncludesThatAreMissingCountToo) {
    const TempFolder folder;
    std::string text = modelAt(0, "ball", kBall);
    for (int i = 0; i < 20'001; ++i) text += "<include><uri>model://none</uri></include>";
    const Result<Scene> scene = importScene(folder.write("room.world", world(text)));
    ASSERT_FALSE(scene);
    EXPECT_NE(scene.error().message.find("more than 20,000"), std::string::npos)
        << scene.error().message;
}

TEST(Gazebo, PosesMayBeRelativeToANestedModel) {
    const TempFolder folder;
    const Scene scene = imported(
        folder.write("room.world", world(modelAt(7, "arm", kBall) +
                                         "<model name='cup'><pose relative_to='arm::__model__'>"
                                         "0 5 0 0 0 0</pose><link name='l'>" +
                                         kBall + "</link></model>")));
    expectBox(scene, "cup", {6, 4, -1}, {8, 6, 1});
}

// Before SDF 1.7 the links of included models were stored with such names.
TEST(Gazebo, LinksMayHaveColonsInTheirNames) {
    const TempFolder folder;
    const Scene scene = imported(folder.write(
        "room.world", world(fmt::format("<model name='robot'><link name='arm::base'>{0}</link>"
                                        "<link name='arm::hand'><pose relative_to='arm::base'>"
                                        "5 0 0 0 0 0</pose>{0}</link><joint name='j' type='fixed'>"
                                        "<parent>arm::base</parent><child>arm::hand</child>"
                                        "</joint></model>",
                                        kBall))));
    EXPECT_EQ(scene.objects.size(), 1U);
    expectBox(scene, "robot", {-1, -1, -1}, {6, 1, 1});
}

// The mesh is red. A transparency of 0.25 leaves an opacity of 0.75.
TEST(Gazebo, TransparencyKeepsTheColour) {
    const TempFolder folder;
    static_cast<void>(folder.write("red.mtl", "newmtl red\nKd 1 0 0\n"));
    static_cast<void>(folder.write("l.obj", fmt::format("mtllib red.mtl\no model\nusemtl red\n{}",
                                                        test::lShapedModel().substr(8))));
    const auto sees = [](const char* transparency) {
        return fmt::format("<transparency>{}</transparency>", transparency);
    };
    const auto diffuse = [](const char* color) {
        return fmt::format("<material><diffuse>{}</diffuse></material>", color);
    };
    const Scene scene = imported(folder.write(
        "room.world",
        world(modelAt(0, "clear", meshVisual("l.obj", sees("0.25"))) +
              modelAt(5, "both", meshVisual("l.obj", sees("0.25") + diffuse("0 0 1 0.5"))) +
              modelAt(10, "plain", meshVisual("l.obj")) +
              modelAt(15, "unseen", meshVisual("l.obj", sees("1"))) +
              modelAt(20, "hidden", meshVisual("l.obj", diffuse("0 0 1 0"))))));
    const auto expectMaterial = [&](const std::string& name, const Eigen::Vector3f& color,
                                    float opacity) {
        const Object* object = find(scene, name);
        ASSERT_NE(object, nullptr) << name;
        const Material& material = scene.materials[scene.triangle_material[object->first_triangle]];
        EXPECT_LT((material.base_color - color).norm(), 1e-3F)
            << name << ": " << material.base_color.transpose();
        EXPECT_NEAR(material.opacity, opacity, 1e-3F) << name;
    };
    expectMaterial("clear", {1, 0, 0}, 0.75F);
    expectMaterial("both", {0, 0, 1}, 0.375F);
    expectMaterial("plain", {1, 0, 0}, 1.0F);
    EXPECT_EQ(scene.objects.size(), 3U);
}

TEST(Gazebo, NamesWhatIsNotReadOfModelsAndShapes) {
    const TempFolder folder;
    static_cast<void>(
        folder.write("l.obj", fmt::format("mtllib gone.mtl\n{}", test::lShapedModel())));
    static_cast<void>(folder.write("empty.obj", "v 0 0 0\n"));
    const auto shape = [](const char* name) {
        return fmt::format("<visual name='v'><geometry><{0}/></geometry></visual>", name);
    };
    const Scene scene = imported(folder.write(
        "room.world", world(modelAt(0, "l", meshVisual("l.obj") + shape("capsule")) +
                            modelAt(5, "e", meshVisual("empty.obj") + shape("capsule")) +
                            modelAt(9, "h", shape("heightmap") + shape("empty")))));
    EXPECT_EQ(scene.objects.size(), 1U);
    EXPECT_TRUE(says(scene.report.notes, "gone.mtl"));
    EXPECT_TRUE(says(scene.report.warnings, "empty.obj ("));
    EXPECT_TRUE(says(scene.report.warnings, "2 visuals are left out, since <capsule>"));
    EXPECT_TRUE(says(scene.report.warnings, "1 visual is left out, since <heightmap>"));
    EXPECT_FALSE(says(scene.report.warnings, "<empty>"));
}

TEST(Gazebo, FaultsAreNamedWithTheirLine) {
    const TempFolder folder;
    const auto place = [&](const std::string& models) {
        const auto path = folder.write("room.world", world("\n" + models));
        const Result<Scene> scene = importScene(path);
        EXPECT_FALSE(scene) << models;
        const std::string where = scene ? "" : scene.error().where;
        EXPECT_TRUE(where.starts_with(path.string() + ":")) << where;
        return where.substr(where.rfind(':') + 1);
    };
    EXPECT_EQ(place("<model name='m'>\n<link name='l'>\n<pose>0 0 x 0 0 0</pose></link></model>"),
              "4");
    EXPECT_EQ(place("<model name='m'>\n<link name='l'><visual name='v'><geometry>\n<mesh><scale>0 "
                    "1 1</scale></mesh></geometry></visual></link></model>"),
              "4");
    EXPECT_EQ(place("<model name='m'>\n<pose relative_to='n'/></model>\n<model name='n'>\n<pose "
                    "relative_to='m'/><link name='l'/></model>"),
              "2");
    // An <include> without a pose keeps the pose in the included file.
    const auto sofa = folder.write("models/sofa/model.sdf",
                                   "<sdf version='1.6'>\n<model name='sofa'>\n<pose>no</pose>\n"
                                   "<link name='l'/></model></sdf>");
    const Result<Scene> included = importScene(
        folder.write("room.world", world("<include><uri>model://sofa</uri></include>")));
    ASSERT_FALSE(included);
    EXPECT_EQ(included.error().where, sofa.string() + ":3");
}

// The parser converts Latin-1, so that its positions may lie behind the end of the file.
TEST(Gazebo, FaultsOfOtherEncodingsAreNamedWithTheirFile) {
    const TempFolder folder;
    const std::string begin = "<?xml version='1.0' encoding='latin1'?><sdf version='1.6'><!--" +
                              std::string(1000, '\xe9') + "-->";
    for (const char* rest : {"<world",
                             "<model name='m'><link name='l'><pose>x</pose>"
                             "</link></model></sdf>"}) {
        const auto path = folder.write("room.world", begin + rest);
        const Result<Scene> scene = importScene(path);
        ASSERT_FALSE(scene);
        EXPECT_EQ(scene.error().where, path.string()) << scene.error().message;
    }
}

TEST(Gazebo, JointsOfMissingLinksAreNamed) {
    const TempFolder folder;
    const Scene scene = imported(folder.write(
        "room.world", world(fmt::format("<model name='m'><link name='a'>{}</link>\n"
                                        "<joint name='j' type='fixed'><parent>a</parent>"
                                        "<child>b</child></joint>\n<joint name='held' "
                                        "type='fixed'><parent>world</parent><child>a</child>"
                                        "</joint></model>",
                                        kBall))));
    EXPECT_TRUE(says(scene.report.warnings,
                     "room.world:2: the joint 'j' names the child link 'b', which does not exist; "
                     "the joint is left out"));
    EXPECT_FALSE(says(scene.report.warnings, "'held'"));
}

// Several links without joints: generic names, and those of several models, get their model's name.
TEST(Gazebo, PlainNamesOfLinksComeWithTheirModel) {
    const TempFolder folder;
    const auto model = [](const std::string& name, int y, const std::string& links) {
        return fmt::format("<model name='{}'><pose>0 {} 0 0 0 0</pose>{}</model>", name, y, links);
    };
    const auto link = [](const std::string& name, int x) {
        return fmt::format("<link name='{}'><pose>{} 0 0 0 0 0</pose>{}</link>", name, x, kBall);
    };
    const Scene scene = imported(folder.write(
        "room.world", world(model("cabinet", 0, link("link_0", 0) + link("handle", 5)) +
                            model("book_1", 5, link("cover", 0) + link("page", 5)) +
                            model("book_2", 10, link("cover", 0) + link("spine", 5)))));
    for (const char* name :
         {"cabinet::link_0", "handle", "book_1::cover", "book_2::cover", "page", "spine"}) {
        EXPECT_NE(find(scene, name), nullptr) << name;
    }
}

// Gazebo's model editor names the parts of a chair link_0, link_0_clone and so on.
TEST(Gazebo, LinksWithoutNamesOfTheirOwnArePartsOfOneObject) {
    const TempFolder folder;
    const auto chairOf = [](int links) {
        std::string text = "<model name='chair'><static>1</static>";
        for (int i = 0; i < links; ++i) {
            text += fmt::format("<link name='link_{}{}'><pose>{} 0 0 0 0 0</pose>{}</link>", i / 2,
                                i % 2 == 0 ? "" : "_clone", i, kBall);
        }
        return world(text + "</model>");
    };
    const Scene chair = imported(folder.write("room.world", chairOf(7)));
    ASSERT_EQ(chair.objects.size(), 1U);
    EXPECT_EQ(chair.objects[0].name, "chair");
    EXPECT_NEAR(2.0 * chair.objects[0].box.half_size.x(), 8.0, 0.05)
        << "seven balls of radius 1, 1 m apart";
    EXPECT_EQ(imported(folder.write("room.world", chairOf(13))).objects.size(), 13U)
        << "too many for one thing";
}

TEST(Gazebo, MaterialsWithoutScriptAreNamed) {
    const TempFolder folder;
    const auto painted = [](double x, const std::string& script) {
        return modelAt(x, script.substr(7),
                       "<visual name='v'><material><script><name>" + script +
                           "</name></script></material><geometry><box><size>1 1 1</size></box>"
                           "</geometry></visual>");
    };
    const Scene scene = imported(
        folder.write("room.world", world(painted(0, "Gazebo/Red") + painted(2, "Custom/cola"))));
    EXPECT_TRUE(says(scene.report.warnings,
                     "1 material is in no script that was found, so its colour and texture are "
                     "missing; give the folder around the models or scripts with --models: "
                     "Custom/cola"));
}

// A building on Gazebo's ground plane is the scene, however large it is.
TEST(Gazebo, TheGroundPlaneIsNoBuilding) {
    const TempFolder folder;
    for (const double size_m : {40.0, 400.0}) {
        std::string mesh = "o house\n";
        for (const double z : {0.0, 3.0}) {
            for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
                mesh += fmt::format("v {} {} {}\n", size_m * x, size_m * y, z);
            }
        }
        mesh += "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
        static_cast<void>(folder.write("house.obj", mesh));
        const Scene scene = imported(
            folder.write("room.world", world("<include><uri>model://ground_plane</uri></include>" +
                                             modelAt(0, "house", meshVisual("house.obj")))));
        EXPECT_GE(scene.room_bounds.sizes().x(), size_m - 0.1);
        EXPECT_NEAR(scene.room_bounds.sizes().z(), 3.0, 0.1) << size_m;
        EXPECT_TRUE(std::ranges::none_of(scene.report.notes, [](const std::string& note) {
            return note.find("house\" is outside") != std::string::npos;
        }));
    }
}

// An office that is one mesh file in one model.
TEST(Gazebo, ABuildingOfOneMeshFileIsSplitByTheNamesInIt) {
    const TempFolder folder;
    for (const double size_m : {6.0, 2.0}) {
        std::string mesh;
        int vertices = 0;
        for (const char* name : {"floor", "desk", "lamp", "sofa"}) {
            const double x = size_m * vertices / 12.0;
            mesh += fmt::format("o {}\n", name);
            for (const auto& [dx, dz] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
                mesh += fmt::format("v {} {} {}\n", x + dx * size_m / 4, dx * size_m, dz);
            }
            mesh += fmt::format("f {} {} {} {}\n", vertices + 1, vertices + 2, vertices + 3,
                                vertices + 4);
            vertices += 4;
        }
        static_cast<void>(folder.write("office.obj", mesh));
        const Scene scene = imported(folder.write(
            "room.world", world(modelAt(0, "office", meshVisual("office.obj")) +
                                fmt::format("<model name='snowman'><pose>20 0 0 0 0 0</pose>"
                                            "<link name='head'>{0}</link><link name='belly'>"
                                            "<pose>0 0 2 0 0 0</pose>{0}</link><joint name='neck'>"
                                            "<parent>belly</parent><child>head</child></joint>"
                                            "</model>",
                                            kBall))));
        const bool is_building = size_m > 4.0;
        EXPECT_EQ(find(scene, "desk") != nullptr, is_building) << size_m;
        EXPECT_EQ(find(scene, "office") == nullptr, is_building) << size_m;
        EXPECT_EQ(scene.objects.size(), is_building ? 5U : 2U) << size_m;
        EXPECT_NE(find(scene, "snowman"), nullptr) << size_m;
    }
}

TEST(Gazebo, ModelsOnFuelAreLookedUpAmongDownloadedOnes) {
    const TempFolder folder;
    const std::string chair = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Office%20Chair";
    const auto path = folder.write(
        "here/room.world",
        world(modelAt(0, "ball", kBall) + "<include><uri>" + chair +
              "</uri><name>chair</name></include><include>"
              "<uri>https://example.org/models/lamp</uri></include>" +
              modelAt(5, "desk",
                      meshVisual("https://fuel.ignitionrobotics.org/1.0/o/models/desk/2/files/"
                                 "meshes/desk.obj"))));
    const Scene without = imported(path);
    EXPECT_TRUE(says(without.report.warnings,
                     "2 models are on Gazebo Fuel and are left out; "
                     "download each with \"gz fuel download -u URI\""));
    EXPECT_TRUE(says(without.report.warnings, chair));
    EXPECT_TRUE(says(without.report.warnings,
                     "1 model or mesh is on the web and is left out; download it and write its "
                     "path in place of the address: https://example.org/models/lamp"));
    // The layout of `gz fuel download`: lower case, one folder per version.
    const std::string kept = "fuel/fuel.gazebosim.org/openrobotics/models/office chair/";
    for (const auto& [version, radius] : {std::pair("2", "1"), {"10", "3"}}) {
        static_cast<void>(folder.write(
            kept + version + "/model.sdf",
            fmt::format("<sdf version='1.6'><model name='c'><link name='l'><visual name='v'>"
                        "<geometry><sphere><radius>{}</radius></sphere></geometry></visual></link>"
                        "</model></sdf>",
                        radius)));
    }
    static_cast<void>(folder.write("fuel/fuel.ignitionrobotics.org/o/models/desk/2/model.sdf", ""));
    static_cast<void>(folder.write("fuel/fuel.ignitionrobotics.org/o/models/desk/2/meshes/desk.obj",
                                   test::lShapedModel()));
    const Scene scene = imported(path, {.model_folders = {folder.path() / "fuel"}});
    expectBox(scene, "chair", {-3, -3, -3}, {3, 3, 3});
    EXPECT_NE(find(scene, "desk"), nullptr);
    EXPECT_FALSE(says(scene.report.warnings, "Fuel"));
}

}  // namespace
}  // namespace dollytrack::gazebo_faults_test
