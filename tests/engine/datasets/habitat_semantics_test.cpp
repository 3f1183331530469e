#include "engine/scene/labels.h"
#include "tests/engine/datasets/habitat_dataset.h"
#include "tests/support/imported_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace dollytrack::habitat_semantics_test {
namespace {

using test::find;
using test::imported;
using test::says;
using test::TempFolder;

constexpr const char* kLexicon =
    R"({"classes": [{"id": 0, "name": "unknown"}, {"id": 7, "name": "potted_plant"},
 {"id": 27, "name": "couch"}]})";

constexpr const char* kPlant = "80794dc5fde2b3276714ff40107bce7b909e45c7";

/// A dataset in the layout of HSSD, whose models are named by numbers: a plant (7) and objects of
/// the classes 0 and 99. `semantics`: the config's sections on semantic files.
std::filesystem::path writeHssd(const TempFolder& folder, const std::string& semantics) {
    static_cast<void>(folder.write(
        "hssd.scene_dataset_config.json",
        R"({"stages": {"paths": {".json": ["stages"]}}, "objects": {"paths": {".json": ["objects/*"]}},
 )" + semantics +
            "}"));
    test::ObjWriter stage(1.0, true);
    stage.room({6, 5, 2.5}, true);
    static_cast<void>(folder.write("stages/102.obj", stage.text()));
    static_cast<void>(
        folder.write("stages/102.stage_config.json", R"({"render_asset": "102.obj"})"));
    const auto object = [&](const std::string& name, int id) {
        static_cast<void>(folder.write("objects/8/" + name + ".obj", test::lShapedModel()));
        static_cast<void>(folder.write(
            "objects/8/" + name + ".object_config.json",
            fmt::format(R"({{"render_asset": "{}.obj", "semantic_id": {}}})", name, id)));
    };
    object(kPlant, 7);
    object("00000000000000000000", 0);
    object("99999999999999999999", 99);
    return folder.write("scenes/102.scene_instance.json",
                        fmt::format(R"({{"stage_instance": {{"template_name": "stages/102"}},
 "object_instances": [{{"template_name": "{}", "translation": [2, 0.5, -2]}},
 {{"template_name": "00000000000000000000", "translation": [2, 0.5, 2]}},
 {{"template_name": "99999999999999999999", "translation": [-2, 0.5, 2]}}]}})",
                                    kPlant));
}

constexpr const char* kByHandle =
    R"("scene_instances": {"default_attributes": {"semantic_scene_instance": "hssd_ssd_map"},
  "paths": {".json": ["scenes"]}},
 "semantic_scene_descriptor_instances": {"hssd_ssd_map": "semantics/hssd-hab_semantic_lexicon.json"})";

constexpr const char* kByPaths = R"("scene_instances": {"default_attributes": {
   "semantic_scene_instance": "%%CONFIG_NAME_AS_ASSET_FILENAME%%.semantic_config.json"},
  "paths": {".json": ["scenes"]}},
 "semantic_scene_descriptor_instances": {
  "default_attributes": {"semantic_descriptor_filename": "../hssd-hab_semantic_lexicon.json"},
  "paths": {".json": ["semantics/scenes/*"]}})";

TEST(HabitatSemantics, AHandleNamesTheLexicon) {
    const TempFolder folder;
    static_cast<void>(folder.write("semantics/hssd-hab_semantic_lexicon.json", kLexicon));
    const Scene scene = imported(writeHssd(folder, kByHandle));
    EXPECT_NE(find(scene, "potted_plant"), nullptr);
    EXPECT_TRUE(says(scene.report.warnings,
                     "1 object has a semantic_id that hssd-hab_semantic_lexicon.json does not "
                     "list: 99"));
}

// The scene's semantic config has regions; the lexicon is that of the default attributes.
TEST(HabitatSemantics, PathsLeadToSemanticConfigsThatNameTheLexicon) {
    const TempFolder folder;
    static_cast<void>(folder.write("semantics/hssd-hab_semantic_lexicon.json", kLexicon));
    const auto path = writeHssd(folder, kByPaths);
    EXPECT_NE(find(imported(path), "potted_plant"), nullptr) << "by the default attributes alone";
    static_cast<void>(
        folder.write("semantics/scenes/102.semantic_config.json", R"({"region_annotations": []})"));
    EXPECT_NE(find(imported(path), "potted_plant"), nullptr);
    static_cast<void>(
        folder.write("semantics/words.json", R"({"classes": [{"id": 7, "name": "lamp"}]})"));
    static_cast<void>(folder.write("semantics/scenes/102.semantic_config.json",
                                   R"({"semantic_descriptor_filename": "../words.json"})"));
    const Scene own = imported(path);
    ASSERT_NE(find(own, "lamp"), nullptr) << "by the config's own lexicon";
    EXPECT_EQ(find(own, "lamp")->nyu40, nyu40FromName("lamp"));
}

TEST(HabitatSemantics, TheOnlyLexiconOfTheDatasetCounts) {
    const TempFolder folder;
    static_cast<void>(folder.write("semantics/hssd-hab_semantic_lexicon.json", kLexicon));
    const Scene scene = imported(writeHssd(
        folder, R"("semantic_scene_descriptor_instances": {"paths": {".json": ["semantics"]}})"));
    EXPECT_NE(find(scene, "potted_plant"), nullptr);
}

TEST(HabitatSemantics, TheTableOfModelsNamesWhatTheLexiconDoesNot) {
    const TempFolder folder;
    static_cast<void>(folder.write("semantics/hssd-hab_semantic_lexicon.json", kLexicon));
    static_cast<void>(folder.write("semantics/objects.csv",
                                   "id,name,main_category,super_category\n"
                                   "00000000000000000000,\"Stool, \"\"wood\"\"\",chair,seat\n"
                                   "99999999999999999999,Thing,lamp,light\n"));
    const Scene scene = imported(writeHssd(folder, kByHandle));
    EXPECT_NE(find(scene, "potted_plant"), nullptr);
    ASSERT_NE(find(scene, "chair"), nullptr);
    EXPECT_EQ(find(scene, "chair")->nyu40, nyu40FromName("chair"));
    EXPECT_NE(find(scene, "lamp"), nullptr);
    EXPECT_FALSE(says(scene.report.warnings, "semantic_id"));
    static_cast<void>(folder.write("semantics/objects.csv", "model;word\n"));
    EXPECT_TRUE(says(imported(folder.path() / "scenes/102.scene_instance.json").report.warnings,
                     "table of models objects.csv was left out"));
}

TEST(HabitatSemantics, WhatCannotBeUsedIsNamed) {
    const TempFolder folder;
    const auto path = writeHssd(folder, kByHandle);
    EXPECT_TRUE(says(imported(path).report.warnings,
                     "semantics/hssd-hab_semantic_lexicon.json (hssd_ssd_map) is missing"));
    static_cast<void>(folder.write("semantics/hssd-hab_semantic_lexicon.json", "{\"classes\": ["));
    EXPECT_TRUE(says(imported(path).report.warnings,
                     "hssd-hab_semantic_lexicon.json cannot be read, so that classes are found"));
    static_cast<void>(folder.write("semantics/hssd-hab_semantic_lexicon.json", "{\"names\": []}"));
    EXPECT_TRUE(says(imported(path).report.warnings,
                     "hssd-hab_semantic_lexicon.json has neither \"classes\""));
    static_cast<void>(writeHssd(folder, kByPaths));
    static_cast<void>(folder.write("semantics/scenes/102.semantic_config.json",
                                   R"({"semantic_descriptor_filename": "gone.json"})"));
    EXPECT_TRUE(says(imported(path).report.warnings, "semantic lexicon gone.json that"));
    // No lexicon is given, although objects have numbers.
    const TempFolder bare;
    EXPECT_TRUE(says(imported(writeHssd(bare, R"("scene_instances": {})")).report.warnings,
                     "2 objects have a semantic_id, but no semantic lexicon has its class"));
}

// A drawer's class and size are in its ao_config.json, as in HSSD's articulated scenes.
TEST(HabitatSemantics, ArticulatedObjectsHaveDescriptionsBesideTheirUrdf) {
    const TempFolder folder;
    const auto path = test::writeDataset(
        folder, R"({"stage_instance": {"template_name": "flat"}, "semantic_scene_instance": "words",
 "articulated_object_instances": [{"template_name": "drawer", "translation": [3, 1, -2]}]})");
    static_cast<void>(folder.write(
        "set/urdf/drawer/drawer.ao_config.json",
        R"({"urdf_filepath": "drawer.urdf", "semantic_id": 6, "uniform_scale": 0.5})"));
    const Scene scene = imported(path);
    ASSERT_NE(find(scene, "drawer"), nullptr);
    EXPECT_EQ(find(scene, "drawer")->nyu40, nyu40FromName("lamp"));
    test::expectBox(scene, "drawer", {2.75, 1.25, 0.5}, {3.75, 2.75, 1.5});
}

}  // namespace
}  // namespace dollytrack::habitat_semantics_test
