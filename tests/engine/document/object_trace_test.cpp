#include "engine/document/object_trace.h"

#include "tests/engine/document/editing.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dollytrack::object_trace_test {
namespace {

using nlohmann::json;

/// Names of the objects with these numbers.
std::vector<std::string> namesOf(const Scene& scene, const std::vector<int>& ids) {
    std::vector<std::string> names;
    for (const int id : ids) names.push_back(scene.object(id).name);
    std::ranges::sort(names);
    return names;
}

/// The pair scene before and after operations that renumber objects.
struct Edited {
    test::Editing editing;
    Scene before = editing.scene();
    ObjectTrace trace_before = traceObjects(editing.imported, {});
    Scene after;
    ObjectTrace trace_after;

    explicit Edited(const json& operations) {
        EXPECT_TRUE(editing.apply(operations).has_value());
        after = editing.scene();
        trace_after = traceObjects(editing.imported, editing.state.edits.scene.definitions);
    }
    [[nodiscard]] int idBefore(const char* name) const { return editing.find(before, name)->id; }
    [[nodiscard]] int idAfter(const char* name) const { return editing.find(after, name)->id; }
    [[nodiscard]] std::vector<std::string> follow(const std::vector<int>& ids) const {
        return namesOf(after, followObjects(ids, trace_before, trace_after));
    }
    [[nodiscard]] std::vector<std::string> followBack(const std::vector<int>& ids) const {
        return namesOf(before, followObjects(ids, trace_after, trace_before));
    }
};

using Names = std::vector<std::string>;

// Unchanged objects are found again, although their numbers have changed.
TEST(ObjectTrace, FollowsWhatWasNotTouchedByName) {
    const Edited scene(json::parse(R"([{"op":"split","object":"pair"}])"));
    ASSERT_NE(scene.idBefore("mug"), scene.idAfter("mug"));
    for (const Object& object : scene.before.objects) {
        if (object.name == "pair") continue;
        EXPECT_EQ(scene.follow({object.id}), Names{object.name});
    }
}

TEST(ObjectTrace, SplittingGivesAllPiecesAndUndoingItTheWhole) {
    const Edited scene(json::parse(R"([{"op":"split","object":"pair"}])"));
    EXPECT_EQ(scene.follow({scene.idBefore("pair")}), (Names{"pair_1", "pair_2"}));
    EXPECT_EQ(scene.followBack({scene.idAfter("pair_1"), scene.idAfter("pair_2")}), Names{"pair"});
    EXPECT_EQ(scene.followBack({scene.idAfter("pair_2")}), Names{"pair"});
}

TEST(ObjectTrace, MergingGivesTheNewObjectAloneAndUndoingItAllParts) {
    const Edited scene(
        json::parse(R"([{"op":"merge","objects":["lamp","mug"],"name":"still life"}])"));
    const std::vector<int> parts = {scene.idBefore("lamp"), scene.idBefore("mug")};
    EXPECT_EQ(scene.follow(parts), Names{"still life"});
    EXPECT_EQ(scene.followBack({scene.idAfter("still life")}), (Names{"lamp", "mug"}));
    EXPECT_EQ(scene.follow({scene.idBefore("pair")}), Names{"pair"});
}

TEST(ObjectTrace, FollowsOneDefinitionAfterAnother) {
    const Edited scene(json::parse(
        R"([{"op":"split","object":"pair"},
            {"op":"merge","objects":["pair_2","mug"],"name":"heap"}])"));
    EXPECT_EQ(scene.follow({scene.idBefore("pair")}), (Names{"heap", "pair_1"}));
    EXPECT_EQ(scene.follow({scene.idBefore("lamp")}), Names{"lamp"});
    EXPECT_EQ(scene.followBack({scene.idAfter("heap")}), (Names{"mug", "pair"}));
}

// Half of the new object was visible, so it is visible.
TEST(ObjectTrace, AnObjectIsHiddenOnlyWhereAllItsPartsWere) {
    const Edited scene(
        json::parse(R"([{"op":"merge","objects":["lamp","mug"],"name":"still life"}])"));
    std::vector<bool> hidden(scene.before.objects.size() + 1, false);
    hidden[scene.idBefore("lamp")] = true;
    hidden[scene.idBefore("pair")] = true;
    std::vector<bool> after = followFlags(hidden, scene.trace_before, scene.trace_after);
    ASSERT_EQ(after.size(), scene.after.objects.size() + 1);
    EXPECT_EQ(std::ranges::count(after, true), 1);
    EXPECT_TRUE(after[scene.idAfter("pair")]);
    hidden[scene.idBefore("mug")] = true;
    after = followFlags(hidden, scene.trace_before, scene.trace_after);
    EXPECT_TRUE(after[scene.idAfter("still life")]);
}

}  // namespace
}  // namespace dollytrack::object_trace_test
