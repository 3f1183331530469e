#include "engine/document/target_filter.h"

#include "engine/document/apply_scene_edits.h"
#include "engine/document/edits_json.h"
#include "engine/document/operation.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <set>

namespace dollytrack::target_filter_test {

TEST(TargetLists, OnlyWhatIsAskedForIsATarget) {
    const Scene scene = test::furnishedRoom();
    const auto namesOf = [](const Scene& edited) {
        std::set<std::string> names;
        for (const Object& object : edited.objects) {
            if (object.role == Role::Target) names.insert(object.name);
        }
        return names;
    };
    const std::set<std::string> all = namesOf(scene);
    ASSERT_EQ(all, (std::set<std::string>{"book", "mug", "picture", "sofa", "table"}));
    const auto with = [&](SceneEdits edits) { return *applySceneEdits(scene, edits); };
    SceneEdits edits;
    edits.ignore = {"M*", "b??k"};
    EXPECT_EQ(namesOf(with(edits)), (std::set<std::string>{"picture", "sofa", "table"}));
    edits = {};
    edits.only = {"sofa", "*t*e"};
    EXPECT_EQ(namesOf(with(edits)), (std::set<std::string>{"picture", "sofa", "table"}));
    edits.ignore = {"picture"};
    EXPECT_EQ(namesOf(with(edits)), (std::set<std::string>{"sofa", "table"}));
    // Changes of single objects take precedence over the lists.
    edits.changes = {{{7, scene.object(7).name}, Role::Target, {}, {}, {}, {}, {}}};
    edits.ignore = {"*"};
    EXPECT_EQ(namesOf(with(edits)), (std::set<std::string>{scene.object(7).name}));
    // Misspelt names cause a warning.
    edits = {};
    edits.ignore = {"sofaa"};
    const Scene slipped = with(edits);
    EXPECT_EQ(namesOf(slipped), all);
    ASSERT_EQ(slipped.report.warnings.size(), 1U);
    EXPECT_NE(slipped.report.warnings[0].find("did you mean 'sofa'"), std::string::npos);

    // So do lists that leave no target.
    const auto warningFor = [&](std::vector<std::string> only, std::vector<std::string> ignore) {
        SceneEdits lists;
        lists.only = std::move(only);
        lists.ignore = std::move(ignore);
        const Scene left = with(lists);
        EXPECT_TRUE(namesOf(left).empty());
        return left.report.warnings.size() == 1 ? left.report.warnings[0] : std::string();
    };
    EXPECT_EQ(warningFor({"floor"}, {}),
              "only 'floor' matches no target of this scene; nothing is left to capture");
    EXPECT_EQ(warningFor({"sofa"}, {"sofa"}),
              "ignore excludes everything in only; nothing is left to capture");
    EXPECT_EQ(warningFor({}, {"*"}), "ignore excludes every target; nothing is left to capture");
    EXPECT_NE(warningFor({"nosuch"}, {}).find("is neither a class nor an object"),
              std::string::npos);

    // An object excluded by the lists can be included by name.
    ProjectState state;
    state.edits.scene.only = {"sofa"};
    const Scene filtered = with(state.edits.scene);
    ASSERT_TRUE(applyOperation(state, {filtered, {}}, {{"op", "include"}, {"object", "mug"}}));
    EXPECT_EQ(namesOf(with(state.edits.scene)), (std::set<std::string>{"mug", "sofa"}));
    ASSERT_TRUE(
        applyOperation(state, {filtered, {}}, {{"op", "only"}, {"what", nlohmann::json::array()}}));
    EXPECT_EQ(state.edits.scene.only, std::vector<std::string>{});
}

TEST(TargetLists, AreKeptInTheProject) {
    Edits edits;
    edits.scene.ignore = {"lamp*", "chair"};
    edits.scene.only = {"bed"};
    edits.plan.pinned = {{"door", lookAt({0, 0, 1}, {1, 0, 1}), {}}};
    edits.plan.start = "door";
    const auto read = editsFromJson(editsJson(edits));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, edits);
    nlohmann::json section = editsJson(edits);
    section["end"] = "window";
    const auto failed = editsFromJson(section);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().where, "edits.end");
    // Removed settings are not stored.
    EXPECT_FALSE(editsJson({}, editsJson(edits)).contains("start"));
}

}  // namespace dollytrack::target_filter_test
