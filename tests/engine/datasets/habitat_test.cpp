#include "engine/io/habitat/habitat_reader.h"
#include "engine/scene/labels.h"
#include "tests/engine/datasets/tiny_datasets.h"
#include "tests/support/imported_scene.h"
#include "tests/support/obj_writer.h"

#include <gtest/gtest.h>

#include <string>

namespace dollytrack {
namespace {

using Eigen::Vector3d;
using test::find;
using test::imported;
using test::says;
using test::TempFolder;

/// The box around an object's own vertices.
Eigen::AlignedBox3d boundsOf(const Scene& scene, const std::string& name) {
    Eigen::AlignedBox3d box;
    const Object* object = find(scene, name);
    if (object == nullptr) return box;
    for (std::uint32_t i = 0; i < object->vertex_count; ++i) {
        box.extend(scene.positions[object->first_vertex + i].cast<double>());
    }
    return box;
}

void expectBox(const Scene& scene, const std::string& name, const Vector3d& low,
               const Vector3d& high) {
    const Eigen::AlignedBox3d box = boundsOf(scene, name);
    EXPECT_TRUE(!box.isEmpty() && (box.min() - low).norm() < 1e-4 && (box.max() - high).norm() < 1e-4)
        << name << ": " << box.min().transpose() << " to " << box.max().transpose();
}

/// A dataset in the layout of ReplicaCAD: configs, models and a lexicon, and one scene.
std::filesystem::path writeDataset(const TempFolder& folder, const std::string& instance) {
    const auto write = [&](const char* name, const std::string& text) {
        return folder.write(std::string("set/") + name, text);
    };
    static_cast<void>(write("flat.scene_dataset_config.json", R"({
 "stages": {"paths": {".json": ["configs/stages"]}},
 "objects": {"paths": {".json": ["configs/objects/*"]}, "default_attributes": {"mass": 1},
  "configs": [{"original_file": "configs/objects/sofa.object_config.json",
               "template_handle": "small_sofa", "attributes": {"scale": [0.5, 0.5, 0.5]}}]},
 "articulated_objects": {"paths": {".urdf": ["urdf/*"]}},
 "scene_instances": {"paths": {".json": ["configs/scenes"]}},
 "semantic_scene_descriptor_instances": {"words": "configs/words_semantic_lexicon.json"}})"));
    static_cast<void>(write("configs/words_semantic_lexicon.json",
                            R"({"classes": [{"id": 5, "name": "sofa"}, {"id": 6, "name": "lamp"}]})"));
    static_cast<void>(write("configs/stages/flat.stage_config.json",
                            R"({"render_asset": "../../models/flat.obj"})"));
    test::ObjWriter stage(1.0, true);
    stage.room({6, 5, 2.5}, true);
    static_cast<void>(write("models/flat.obj", stage.text()));
    static_cast<void>(write("configs/objects/sofa.object_config.json",
                            R"({"render_asset": "../../models/l.obj", "semantic_id": 5})"));
    static_cast<void>(write("configs/objects/tipped.object_config.json", R"({
 "render_asset": "../../models/l.obj", "up": [0, 0, 1], "front": [0, 1, 0], "COM": [0, 0, 0]})"));
    static_cast<void>(write("models/l.obj", test::lShapedModel()));
    static_cast<void>(write("urdf/drawer/drawer.urdf", R"(<robot name="drawer">
 <link name="body"><visual><geometry><box size="1 2 3"/></geometry></visual></link>
 <link name="front"><visual><origin xyz="0 0 1"/><geometry><box size="1 1 1"/></geometry></visual></link>
 <joint name="rail" type="prismatic"><origin xyz="1 0 0"/><parent link="body"/><child link="front"/></joint>
</robot>)"));
    return write("configs/scenes/flat.scene_instance.json", instance);
}

// The L is 2 x 0.5 x 2 with its middle at (0, 0.25, 0.5); the file's (x, y, z) is (x, -z, y) here.
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
    // By default the middle of the model's box is placed.
    expectBox(scene, "sofa_2", {1.0, -1.0, 0.75}, {5.0, 3.0, 1.25});
    EXPECT_EQ(find(scene, "sofa_2")->nyu40, nyu40FromName("lamp")) << "by its own semantic_id";
    expectBox(scene, "small_sofa", {-0.5, -0.75, 0.0}, {0.5, 0.25, 0.25});
    // A part of a name will do. Its own z is up, its y forward: (x, y, z) stands at (x, z, -y) of the scene, (x, y, z) here.
    expectBox(scene, "tippe", {-1.0, 0.0, -0.5}, {1.0, 0.5, 1.5});
    // Body and front, of which the joint moves the second: x from -0.5 to 1.5, halved.
    expectBox(scene, "drawer", {4.75, -0.75, -0.5}, {5.75, 0.75, 0.5});
    EXPECT_EQ(find(scene, "floor")->role, Role::Structure);
    EXPECT_EQ(scene.report.unit_m, 1.0);
    EXPECT_TRUE(says(scene.report.warnings, "not_there"));
    EXPECT_TRUE(says(scene.report.warnings, "placements that are none") ||
                says(scene.report.warnings, "placement that is none"));
}

TEST(Habitat, ADatasetConfigIsItsOnlySceneOrNamesThem) {
    const TempFolder folder;
    const std::string instance =
        R"({"stage_instance": {"template_name": "flat"}, "object_instances": [
 {"template_name": "sofa", "translation": [3, 1, -2]}]})";
    const auto first = writeDataset(folder, instance);
    const auto config = folder.path() / "set" / "flat.scene_dataset_config.json";
    EXPECT_NE(find(imported(config), "sofa"), nullptr);
    static_cast<void>(folder.write("set/configs/scenes/attic.scene_instance.json", instance));
    const Result<Scene> several = importScene(config);
    ASSERT_FALSE(several);
    EXPECT_NE(several.error().message.find("2 scenes (attic, flat)"), std::string::npos)
        << several.error().message;
    const auto scenes = habitat::scenesOfDataset(config);
    ASSERT_TRUE(scenes);
    ASSERT_EQ(scenes->size(), 2U);
    EXPECT_EQ((*scenes)[1], first);
}

TEST(Habitat, NeverLooksOutsideOfTheDataset) {
    const TempFolder folder;
    static_cast<void>(folder.write("secret.obj", test::lShapedModel()));
    static_cast<void>(folder.write("set/configs/objects/evil.object_config.json",
                                   R"({"render_asset": "../../../secret.obj"})"));
    std::filesystem::create_directories(folder.path() / "set" / "models");
    std::filesystem::create_symlink(folder.path() / "secret.obj",
                                    folder.path() / "set" / "models" / "link.obj");
    static_cast<void>(folder.write("set/configs/objects/link.object_config.json",
                                   R"({"render_asset": "../../models/link.obj"})"));
    const Scene scene = imported(writeDataset(folder, R"({"stage_instance": {"template_name": "flat"},
 "object_instances": [{"template_name": "evil"}, {"template_name": "link"},
                      {"template_name": "../../../etc/passwd"}]})"));
    EXPECT_EQ(test::countTargets(scene), 0);
    EXPECT_TRUE(says(scene.report.warnings, "3 models are not in the dataset's folder"));
}

TEST(Habitat, DamagedFilesAreRefused) {
    const TempFolder folder;
    for (const char* text : {R"({"stage_instance": 7, "object_instances": {}})",
                             R"({"stage_instance": {"template_name": "flat"}, "object_instances": [)",
                             R"({"stage_instance": {"template_name": "none"}})"}) {
        const Result<Scene> scene = importScene(writeDataset(folder, text));
        ASSERT_FALSE(scene) << text;
        EXPECT_EQ(scene.error().code, ErrorCode::BadInput) << text;
    }
}

}  // namespace
}  // namespace dollytrack
