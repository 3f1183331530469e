#include "engine/io/habitat/habitat_reader.h"
#include "engine/scene/labels.h"
#include "tests/engine/datasets/habitat_dataset.h"
#include "tests/engine/datasets/tiny_datasets.h"
#include "tests/support/imported_scene.h"
#include "tests/support/obj_writer.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace dollytrack::habitat_test {
namespace {

using Eigen::Vector3d;
using test::expectBox;
using test::find;
using test::imported;
using test::says;
using test::TempFolder;
using test::writeDataset;

std::vector<std::string> linesOf(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

// The L is 2 x 0.5 x 2 with its centre at (0, 0.25, 0.5); the file's (x, y, z) is (x, -z, y) in the
// world.
TEST(Habitat, PlacesObjectsAsTheSceneInstanceSays) {
    const TempFolder folder;
    const Scene scene = imported(writeDataset(folder, R"({
 "stage_instance": {"template_name": "flat"}, "semantic_scene_instance": "words",
 "object_instances": [
  {"template_name": "sofa", "translation_origin": "asset_local", "translation": [1, 0.2, 2],
   "rotation": [0.7071067811865476, 0, 0.7071067811865476, 0]},
  {"template_name": "configs/objects/sofa", "translation": [3, 1, -1], "uniform_scale": 2,
   "non_uniform_scale": [1, 0.5, 1], "semantic_id": 6},
  {"template_name": "small_sofa", "translation_origin": "asset_local", "translation": [0, 0, 0]},
  {"template_name": "tippe", "translation": [0, 0, 0]},
  {"template_name": "not_there", "translation": [0, 0, 0]},
  {"template_name": "sofa", "translation": [0, "x", 0]}],
 "articulated_object_instances": [
  {"template_name": "drawer", "translation": [5, 0, 0], "uniform_scale": 0.5}]})"));
    expectBox(scene, "sofa", {0.5, -3.0, 0.2}, {2.5, -1.0, 0.7});
    EXPECT_EQ(find(scene, "sofa")->nyu40, nyu40FromName("sofa"));
    // By default the pose is that of the model's box centre.
    expectBox(scene, "sofa_2", {1.0, -1.0, 0.75}, {5.0, 3.0, 1.25});
    EXPECT_EQ(find(scene, "sofa_2")->nyu40, nyu40FromName("lamp")) << "by its own semantic_id";
    expectBox(scene, "small_sofa", {-0.5, -0.75, 0.0}, {0.5, 0.25, 0.25});
    // A part of the name is sufficient. The model's z is up and y forward, as in the world.
    expectBox(scene, "tippe", {-1.0, 0.0, -0.5}, {1.0, 0.5, 1.5});
    // Body and front, which a joint moves: x from -0.5 to 1.5, scaled by 0.5.
    expectBox(scene, "drawer", {4.75, -0.75, -0.5}, {5.75, 0.75, 0.5});
    EXPECT_EQ(find(scene, "floor")->role, Role::Structure);
    EXPECT_EQ(scene.report.unit_m, 1.0);
    EXPECT_TRUE(says(scene.report.warnings, "not_there"));
    EXPECT_TRUE(says(scene.report.warnings, "no valid translation, rotation or scale"));
}

TEST(Habitat, ADatasetConfigIsItsOnlySceneOrNamesThem) {
    const TempFolder folder;
    const std::string instance =
        R"({"stage_instance": {"template_name": "flat"}, "object_instances": [
 {"template_name": "sofa", "translation": [3, 1, -2]}]})";
    const auto first = writeDataset(folder, instance);
    const auto config = folder.path() / "set" / "flat.scene_dataset_config.json";
    EXPECT_NE(find(imported(config), "sofa"), nullptr);
    static_cast<void>(folder.write("set/configs/scenes/attic_10.scene_instance.json", instance));
    static_cast<void>(folder.write("set/configs/scenes/attic_2.scene_instance.json", instance));
    const Result<Scene> several = importScene(config);
    ASSERT_FALSE(several);
    EXPECT_NE(several.error().message.find("3 scenes (attic_2, attic_10, flat)"), std::string::npos)
        << several.error().message;
    const auto scenes = habitat::scenesOfDataset(config);
    ASSERT_TRUE(scenes);
    ASSERT_EQ(scenes->size(), 3U);
    EXPECT_EQ((*scenes)[2], first);
}

// Habitat-sim rotates the model to its axes, scales it, moves it by -scale * COM, and applies the
// instance's rotation: here half a turn about y.
TEST(Habitat, PlacesTheCentreOfMass) {
    const TempFolder folder;
    const auto scene_file = writeDataset(folder, R"({"stage_instance": {"template_name": "flat"},
 "object_instances": [{"template_name": "heavy", "rotation": [0, 0, 1, 0]},
                      {"template_name": "computed"}, {"template_name": "origin"}]})");
    static_cast<void>(folder.write("set/configs/objects/heavy.object_config.json", R"({
 "render_asset": "../../models/l.obj", "up": [0, 0, 1], "front": [0, 1, 0],
 "COM": [0.5, 0.5, 0], "scale": [2, 2, 2]})"));
    static_cast<void>(folder.write("set/configs/objects/computed.object_config.json", R"({
 "render_asset": "../../models/l.obj", "COM": [5, 5, 5], "compute_COM_from_shape": true})"));
    static_cast<void>(folder.write("set/configs/objects/origin.object_config.json", R"({
 "render_asset": "../../models/l.obj", "compute_COM_from_shape": false})"));
    const Scene scene = imported(scene_file);
    expectBox(scene, "heavy", {-1.0, -1.0, -2.0}, {3.0, 0.0, 2.0});
    expectBox(scene, "computed", {-1.0, -1.0, -0.25}, {1.0, 1.0, 0.25});
    expectBox(scene, "origin", {-1.0, -1.5, 0.0}, {1.0, 0.5, 0.5});
}

TEST(Habitat, InstancesShareMaterialsAndWarningsOfModels) {
    const TempFolder folder;
    const auto sceneWith = [&](const std::string& articulated) {
        const auto scene_file =
            writeDataset(folder, R"({"stage_instance": {"template_name": "flat"},
 "articulated_object_instances": [)" +
                                     articulated + "]}");
        for (const char* name : {"left", "right"}) {
            static_cast<void>(folder.write(std::string("set/urdf/") + name + "/" + name + ".urdf",
                                           R"(<robot name="box"><link name="body">
 <visual><geometry><box size="1 1 1"/></geometry></visual>
 <visual><geometry><mesh filename="missing.obj"/></geometry></visual></link></robot>)"));
        }
        return imported(scene_file);
    };
    const Scene one = sceneWith(R"({"template_name": "left"})");
    const Scene three = sceneWith(R"({"template_name": "left", "translation": [1, 0.5, -1]},
 {"template_name": "left", "translation": [3, 0.5, -1]},
 {"template_name": "left", "translation": [3, 0.5, -3]})");
    EXPECT_EQ(one.materials.size(), three.materials.size());
    EXPECT_EQ(test::countTargets(three), 3);
    const Scene both = sceneWith(R"({"template_name": "left", "translation": [1, 0.5, -1]},
 {"template_name": "right", "translation": [3, 0.5, -1]})");
    EXPECT_TRUE(says(both.report.warnings, "left, right: "));
    const Scene hidden = sceneWith(R"({"template_name": "left", "translation": [1, 0.5, -1]},
 {"template_name": "left", "translation": [3, 0.5, -1], "is_instance_visible": false})");
    EXPECT_EQ(test::countTargets(hidden), 1);
    EXPECT_TRUE(says(hidden.report.notes, "1 object is marked as invisible"));
}

// The semantic mesh has z up and -y forward: half a turn that its box does not reveal.
TEST(Habitat, SemanticMeshesHaveTheirOwnAxes) {
    const TempFolder folder;
    static_cast<void>(folder.write("mesh_semantic.ply", R"(ply
format ascii 1.0
element vertex 12
property float x
property float y
property float z
element face 7
property list uchar int vertex_indices
property int object_id
end_header
-3 -3 0
3 -3 0
3 3 0
-3 3 0
1 1.5 0
2 1.5 0
2 2 0
1 2 0
1 1.5 0.8
2 1.5 0.8
2 2 0.8
1 2 0.8
4 0 1 2 3 1
4 4 7 6 5 2
4 8 9 10 11 2
4 4 5 9 8 2
4 5 6 10 9 2
4 6 7 11 10 2
4 7 4 8 11 2
)"));
    static_cast<void>(folder.write(
        "info_semantic.json",
        R"({"objects": [{"id": 1, "class_name": "floor"}, {"id": 2, "class_name": "chair"}]})"));
    test::ObjWriter room(1.0, true);
    room.object("all").quad({-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
    room.box({1, 1.5, 0}, {2, 2, 0.8});
    static_cast<void>(folder.write("room.obj", room.text()));
    const std::string stage = R"({"render_asset": "room.obj", "semantic_asset": "mesh_semantic.ply",
 "up": [0, 1, 0], "front": [0, 0, -1], "semantic_up": [0, 0, 1], "semantic_front": )";
    const auto turned = folder.write("turned.stage_config.json", stage + "[0, -1, 0]}");
    expectBox(imported(turned), "chair", {-2.0, -2.0, 0.0}, {-1.0, -1.5, 0.8});
    // A quarter turn about x: labels are transferred to the rendered model.
    const auto quarter = folder.write("quarter.stage_config.json", stage + "[0, 1, 0]}");
    expectBox(imported(quarter), "chair", {1.0, 1.5, 0.0}, {2.0, 2.0, 0.8});
}

TEST(Habitat, AStageAloneTakesTheAxesAndScaleOfItsDataset) {
    const TempFolder folder;
    static_cast<void>(folder.write("stages/l.obj", test::lShapedModel()));
    const auto write = [&](const std::string& attributes) {
        return folder.write("one.scene_dataset_config.json",
                            R"({"stages": {"paths": {".obj": ["stages/*.obj"]},
 "default_attributes": {)" + attributes +
                                "}}}");
    };
    const auto config = write(R"("up": [0, 0, 1], "front": [0, 1, 0], "scale": [2, 2, 2])");
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3f& p : imported(config).positions) box.extend(p.cast<double>());
    ASSERT_FALSE(box.isEmpty());
    EXPECT_LT((box.min() - Vector3d(-2.0, 0.0, -1.0)).norm(), 1e-4) << box.min().transpose();
    EXPECT_LT((box.max() - Vector3d(2.0, 1.0, 3.0)).norm(), 1e-4) << box.max().transpose();
    // A batch would read the model without its config.
    const auto refused = habitat::scenesOfDataset(config);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("stage config"), std::string::npos);
    const auto plain = habitat::scenesOfDataset(write(R"("friction_coefficient": 0.3)"));
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->size(), 1U);
}

// "stage" is also a piece of furniture; in a dataset it names the room.
TEST(Habitat, AStageOfOneMeshIsTheBuilding) {
    const TempFolder folder;
    const auto scene_file = writeDataset(folder, R"({"stage_instance": {"template_name": "flat"},
 "object_instances": [{"template_name": "sofa", "translation": [3, 1, -2]}]})");
    std::string stage = "o stage\n";
    for (const std::string& line : linesOf(folder.path() / "set/models/flat.obj")) {
        if (!line.starts_with("o ") && !line.starts_with("g ")) stage += line + "\n";
    }
    static_cast<void>(folder.write("set/models/flat.obj", stage));
    const Scene scene = imported(scene_file);
    ASSERT_NE(find(scene, "stage"), nullptr);
    EXPECT_EQ(find(scene, "stage")->role, Role::Structure);
    EXPECT_EQ(find(scene, "stage")->nyu40, kNyuOtherStructure);
    EXPECT_EQ(find(scene, "sofa")->role, Role::Target);
}

TEST(Habitat, NeverLooksOutsideOfTheDataset) {
    const TempFolder folder;
    const auto secret = folder.write("secret.obj", test::lShapedModel());
    static_cast<void>(
        folder.write("outside/spy.object_config.json", R"({"render_asset": "../secret.obj"})"));
    static_cast<void>(folder.write("outside/spy.obj", test::lShapedModel()));
    const auto object = [&](const std::string& name, const std::string& asset) {
        static_cast<void>(folder.write("set/configs/objects/" + name + ".object_config.json",
                                       R"({"render_asset": ")" + asset + R"("})"));
    };
    object("dots", "../../../secret.obj");
    object("absolute", secret.string());
    object("link", "../../models/link.obj");
    object("folder_link", "../../models/outside/spy.obj");
    const auto scene_file = writeDataset(folder, R"({"stage_instance": {"template_name": "flat"},
 "object_instances": [{"template_name": "dots"}, {"template_name": "absolute"},
  {"template_name": "link"}, {"template_name": "folder_link"}, {"template_name": "linked_config"},
  {"template_name": "../outside/spy"}, {"template_name": "spy"}]})");
    std::filesystem::create_symlink(secret, folder.path() / "set/models/link.obj");
    std::filesystem::create_directory_symlink(folder.path() / "outside",
                                              folder.path() / "set/models/outside");
    std::filesystem::create_directory_symlink(folder.path() / "outside",
                                              folder.path() / "set/configs/objects/more");
    std::filesystem::create_symlink(folder.path() / "outside/spy.object_config.json",
                                    folder.path() /
                                        "set/configs/objects/"
                                        "linked_config.object_config.json");
    const Scene scene = imported(scene_file);
    EXPECT_EQ(test::countTargets(scene), 0);
    EXPECT_TRUE(says(scene.report.warnings, "7 models are not in the dataset's folder"));

    // The config's own paths lead out, too.
    static_cast<void>(folder.write("set/flat.scene_dataset_config.json",
                                   R"({
 "stages": {"paths": {".json": ["configs/stages"]}},
 "objects": {"paths": {".json": ["../outside", "../out*/*", ")" +
                                       folder.path().string() +
                                       R"(/outside", "configs/objects/more/*"]},
  "configs": [{"template_handle": "dots", "attributes": {"render_asset": "../secret.obj"}}]}})"));
    const Scene again = imported(scene_file);
    EXPECT_EQ(test::countTargets(again), 0);
    EXPECT_TRUE(says(again.report.warnings, "7 models are not in the dataset's folder"));
}

TEST(Habitat, OpensNoFolderButTheDatasets) {
    for (const char* path : {"/scenes/flat.scene_instance.json", "/stages/a.stage_config.json"}) {
        for (const auto& folder : habitat::habitatInputs(path, {})) {
            EXPECT_TRUE(folder.has_relative_path()) << folder;
        }
    }
    const TempFolder folder;
    const auto scene = folder.write("set/a/b/flat.scene_instance.json", "{}");
    const auto config = folder.write("flat.scene_dataset_config.json", "[[[ not read here");
    std::filesystem::create_symlink(config, folder.path() / "set/link.scene_dataset_config.json");
    EXPECT_EQ(habitat::habitatInputs(scene, {}).front(), folder.path());
    std::filesystem::remove(config);
    EXPECT_EQ(habitat::habitatInputs(scene, {}).front(), scene.parent_path());
}

TEST(Habitat, ConfigsOfTooManyPathsAreRefused) {
    const TempFolder folder;
    std::string paths = R"("stages")";
    for (int i = 0; i < 2'000; ++i) paths += R"(, "stages")";
    const auto config = folder.write("many.scene_dataset_config.json",
                                     R"({"stages": {"paths": {".json": [)" + paths + "]}}}");
    const auto scenes = habitat::scenesOfDataset(config);
    ASSERT_FALSE(scenes);
    EXPECT_NE(scenes.error().message.find("more than 2000 paths of stages"), std::string::npos)
        << scenes.error().message;
}

TEST(Habitat, NamesThatAreNotSearchedForAreSaid) {
    const TempFolder folder;
    std::string objects = R"({"template_name": "none"})";
    for (int i = 0; i < 2'000; ++i) {
        objects += R"(, {"template_name": "none_)" + std::to_string(i) + R"("})";
    }
    const Scene scene = imported(writeDataset(
        folder,
        R"({"stage_instance": {"template_name": "flat"}, "object_instances": [)" + objects + "]}"));
    EXPECT_TRUE(says(scene.report.warnings, "more than 2,000 template names"));
}

TEST(Habitat, DamagedFilesAreRefused) {
    const TempFolder folder;
    const std::string deep = R"({"object_instances": )" + std::string(200, '[');
    for (const char* text :
         {R"({"stage_instance": 7, "object_instances": {}})",
          R"({"stage_instance": {"template_name": "flat"}, "object_instances": [)",
          R"({"stage_instance": {"template_name": "none"}})", deep.c_str()}) {
        const Result<Scene> scene = importScene(writeDataset(folder, text));
        ASSERT_FALSE(scene) << text;
        EXPECT_EQ(scene.error().code, ErrorCode::BadInput) << text;
    }
    const auto scene_file =
        writeDataset(folder, R"({"stage_instance": {"template_name": "flat"}})");
    static_cast<void>(folder.write("set/flat.scene_dataset_config.json",
                                   R"({"stages": )" + std::string(200, '[')));
    const Result<Scene> scene = importScene(scene_file);
    ASSERT_FALSE(scene);
    EXPECT_NE(scene.error().message.find("nested"), std::string::npos) << scene.error().message;
}

}  // namespace
}  // namespace dollytrack::habitat_test
