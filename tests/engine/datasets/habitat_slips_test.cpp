#include "engine/core/log.h"
#include "engine/io/habitat/habitat_reader.h"
#include "tests/engine/datasets/habitat_dataset.h"
#include "tests/support/imported_scene.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dollytrack::habitat_slips_test {
namespace {

using test::find;
using test::imported;
using test::says;
using test::TempFolder;
using test::writeDataset;

constexpr const char* kSofa = R"({"stage_instance": {"template_name": "flat"},
 "object_instances": [{"template_name": "sofa", "translation": [3, 1, -2]}]})";

TEST(HabitatSlips, MisspeltKeysAreNamed) {
    const TempFolder folder;
    const auto path = writeDataset(folder, R"({"stage_instance": {"template_name": "flat"},
 "object_instances": [{"template_name": "sofa", "translaton": [3, 1, -2], "my_note": 1},
 {"template_name": "sofa", "translaton": [1, 1, -2]}], "articulated_objects_instances": []})");
    static_cast<void>(folder.write("set/configs/objects/sofa.object_config.json",
                                   R"({"render_asset": "../../models/l.obj", "semantic_ids": 5})"));
    const Scene scene = imported(path);
    const auto count = [&](const std::string& words) {
        int lines = 0;
        for (const std::string& line : scene.report.warnings) {
            lines += line.find(words) != std::string::npos ? 1 : 0;
        }
        return lines;
    };
    EXPECT_EQ(count("flat.scene_instance.json: the key \"translaton\" is unknown and was not read; "
                    "did you mean \"translation\"?"),
              1);
    EXPECT_EQ(count("did you mean \"articulated_object_instances\"?"), 1);
    EXPECT_EQ(count("sofa.object_config.json: the key \"semantic_ids\""), 1);
    EXPECT_EQ(count("my_note"), 0);
    EXPECT_EQ(count("is unknown"), 3);
}

TEST(HabitatSlips, NamesOfTemplatesThatFitSeveralOrNoFilesAreNamed) {
    const TempFolder folder;
    const auto path = writeDataset(folder, R"({"stage_instance": {"template_name": "flat"},
 "object_instances": [{"template_name": "chair", "translation": [3, 1, -2]},
 {"template_name": "soofa"}, {"template_name": "hollow"}]})");
    for (const char* name : {"chair_1", "chair_2"}) {
        static_cast<void>(
            folder.write(std::string("set/configs/objects/") + name + ".object_config.json",
                         R"({"render_asset": "../../models/l.obj"})"));
    }
    static_cast<void>(folder.write("set/configs/objects/hollow.object_config.json",
                                   R"({"render_asset": "gone.glb"})"));
    const Scene scene = imported(path);
    EXPECT_NE(find(scene, "chair"), nullptr);
    EXPECT_TRUE(
        says(scene.report.warnings,
             "the template name \"chair\" matches several files (chair_1.object_config.json, "
             "chair_2.object_config.json), and the first is used"));
    EXPECT_TRUE(says(scene.report.warnings, "soofa (no file has this name; did you mean \"sofa\""));
    EXPECT_TRUE(says(scene.report.warnings, "hollow (gone.glb)"));
    // A full name causes no warning.
    EXPECT_FALSE(says(imported(writeDataset(folder, kSofa)).report.warnings, "matches several"));
}

/// The dataset of writeDataset() whose config has other paths of scene instances.
std::filesystem::path writeConfig(const TempFolder& folder, const std::string& scenes) {
    static_cast<void>(writeDataset(folder, kSofa));
    return folder.write("set/flat.scene_dataset_config.json",
                        R"({"stages": {"paths": {".json": ["configs/stages"]}},
 "objects": {"paths": {".json": ["configs/objects/*", "configs/more/*"]}}, )" +
                            scenes + "}");
}

TEST(HabitatSlips, PathsOfScenesThatLeadNowhereAreSaid) {
    const TempFolder folder;
    const auto config = writeConfig(
        folder, R"("scene_instances": {"paths": {".json": ["configs/scene", "more/*"]}})");
    const std::string words =
        "the paths of scene_instances in flat.scene_dataset_config.json match no file "
        "(configs/scene";
    // The only stage is a scene.
    EXPECT_TRUE(says(imported(config).report.warnings, words));
    std::vector<std::string> said;
    const log::Sink before =
        log::setSink([&](const log::Record& record) { said.push_back(record.message); });
    const auto scenes = habitat::scenesOfDataset(config);
    log::flush();
    log::setSink(before);
    ASSERT_TRUE(scenes);
    EXPECT_EQ(scenes->size(), 1U);
    EXPECT_TRUE(says(said, words));
    std::filesystem::remove_all(folder.path() / "set/configs/stages");
    const Result<Scene> none = importScene(config);
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find(words), std::string::npos) << none.error().message;
}

TEST(HabitatSlips, AConfigWithStagesAloneHasAScenePerStage) {
    const TempFolder folder;
    const auto config = writeConfig(folder, R"("light_setups": {})");
    EXPECT_FALSE(says(imported(config).report.warnings, "match no file"));
    static_cast<void>(folder.write("set/configs/stages/attic.stage_config.json",
                                   R"({"render_asset": "../../models/flat.obj"})"));
    const auto scenes = habitat::scenesOfDataset(config);
    ASSERT_TRUE(scenes);
    EXPECT_EQ(scenes->size(), 2U);
}

// Missing objects are in folders that a path of the config should match.
TEST(HabitatSlips, PathsOfObjectsMatterWhenOneIsMissing) {
    const TempFolder folder;
    static_cast<void>(
        writeConfig(folder, R"("scene_instances": {"paths": {".json": ["configs/scenes"]}})"));
    const auto path = folder.path() / "set/configs/scenes/flat.scene_instance.json";
    EXPECT_FALSE(says(imported(path).report.warnings, "match no file"));
    static_cast<void>(folder.write("set/configs/scenes/flat.scene_instance.json",
                                   R"({"stage_instance": {"template_name": "flat"},
 "object_instances": [{"template_name": "table"}]})"));
    EXPECT_TRUE(says(imported(path).report.warnings,
                     "some paths of objects in flat.scene_dataset_config.json match no file: "
                     "configs/more/*"));
}

}  // namespace
}  // namespace dollytrack::habitat_slips_test
