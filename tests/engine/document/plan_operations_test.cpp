#include "tests/engine/document/editing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dollytrack::plan_operations_test {
namespace {

using nlohmann::json;
using test::Editing;

}  // namespace

TEST(Operation, BoxesAreRenamedToNamesOfTheirOwn) {
    Editing editing;
    const json box = {{"op", "add_no_go"}, {"center", {1, 1, 1}}, {"size", {1, 1, 1}}};
    ASSERT_TRUE(editing.apply(json::array({box, box})));
    const auto rename = [&](const char* from, const char* to) {
        return editing.apply(json::array({{{"op", "rename_no_go"}, {"name", from}, {"to", to}}}));
    };
    const auto named = [&](std::size_t i) { return editing.state.edits.plan.no_go[i].name; };
    const auto done = rename("no-go box 2", "stairs");
    ASSERT_TRUE(done);
    EXPECT_EQ(done->front(), "Rename no-go box 2 to stairs");
    EXPECT_EQ(named(1), "stairs");
    EXPECT_TRUE(rename("stairs", "stairs")) << "its own name is free";
    const auto taken = rename("stairs", "no-go box");
    ASSERT_FALSE(taken);
    EXPECT_NE(taken.error().message.find("already called 'no-go box'"), std::string::npos);
    EXPECT_FALSE(rename("stairs", ""));
    EXPECT_EQ(named(1), "stairs");
}

TEST(Operation, PointsAndBoxesAreNamedMovedAndRemoved) {
    Editing editing;
    ASSERT_TRUE(editing.apply({
        {{"op", "add_point"}, {"position", {1, 1, 1}}, {"yaw_deg", 90}, {"pitch_deg", -30}},
        {{"op", "add_point"}, {"position", {1, 1, 1}}, {"target", {3, 1, 1}}},
        {{"op", "move_point"}, {"point", "view"}, {"position", {1, 1.5, 1}}},
        {{"op", "add_no_go"}, {"center", {1, 1, 1}}, {"size", {1, 2, 3}}, {"yaw_deg", 30}},
        {{"op", "move_no_go"}, {"name", "no-go box"}, {"center", {2, 1, 1}}},
    }));
    const PlanEdits& plan = editing.state.edits.plan;
    EXPECT_EQ(plan.pinned[1].name, "view 2");
    EXPECT_EQ(plan.pinned[0].pose.position, Eigen::Vector3d(1, 1.5, 1));
    const Eigen::Vector3d forward = plan.pinned[0].pose.forward();
    EXPECT_NEAR(forward.y(), std::cos(std::numbers::pi / 6), 1e-12);
    EXPECT_NEAR(forward.z(), -0.5, 1e-12);
    EXPECT_NEAR((plan.pinned[0].pose.rotation * Eigen::Vector3d::UnitX()).z(), 0.0, 1e-12);
    EXPECT_EQ(plan.no_go[0].box.center, Eigen::Vector3d(2, 1, 1));
    EXPECT_EQ(plan.no_go[0].box.half_size, Eigen::Vector3d(0.5, 1, 1.5));
    EXPECT_NEAR(plan.no_go[0].box.yaw, std::numbers::pi / 6, 1e-12);
    ASSERT_TRUE(editing.apply({{{"op", "unpin"}, {"point", "view"}},
                               {{"op", "unpin"}, {"point", "view 2"}},
                               {{"op", "remove_no_go"}, {"name", "no-go box"}}}));
    EXPECT_EQ(editing.state, ProjectState{});
}

TEST(Operation, EndsGoWithTheirPointsAndTakeNobodyElses) {
    Editing editing;
    const PlanEdits& plan = editing.state.edits.plan;
    ASSERT_TRUE(editing.apply({
        {{"op", "pin"},
         {"objects", {"lamp"}},
         {"name", "start"},
         {"position", {1, 1, 1}},
         {"yaw_deg", 0}},
        {{"op", "set_start"}, {"position", {2, 1, 1}}, {"yaw_deg", 0}},
    }));
    ASSERT_EQ(plan.pinned.size(), 2U);
    EXPECT_EQ(plan.pinned[0].pose.position, Eigen::Vector3d(1, 1, 1));
    EXPECT_EQ(plan.start, "start 2");
    ASSERT_TRUE(editing.apply(
        json::array({{{"op", "set_start"}, {"position", {3, 1, 1}}, {"yaw_deg", 0}}})));
    EXPECT_EQ(plan.pinned.size(), 2U) << "the end that was made is moved";
    EXPECT_EQ(plan.pinned[1].pose.position, Eigen::Vector3d(3, 1, 1));
    ASSERT_TRUE(editing.apply({{{"op", "set_end"}, {"point", "start"}},
                               {{"op", "remove_point"}, {"objects", {"lamp"}}}}));
    EXPECT_EQ(plan.end, "") << "its point is gone";
    EXPECT_EQ(plan.start, "start 2");
}

TEST(Operation, NamesWhatWasDoneToABoxOrAView) {
    Editing editing;
    ASSERT_TRUE(editing.apply({
        {{"op", "add_no_go"}, {"center", {1, 1, 1}}, {"size", {1, 2, 3}}},
        {{"op", "add_point"}, {"position", {1, 1, 1}}, {"yaw_deg", 90}},
    }));
    const auto nameOf = [&](const json& operation) {
        const auto names = editing.apply(json::array({operation}));
        return names ? names->front() : describe(names.error());
    };
    const auto box = [&](const json& center, const json& size, double yaw_deg) {
        return nameOf({{"op", "move_no_go"},
                       {"name", "no-go box"},
                       {"center", center},
                       {"size", size},
                       {"yaw_deg", yaw_deg}});
    };
    EXPECT_EQ(box({2, 1, 1}, {1, 2, 3}, 0), "Move no-go box");
    EXPECT_EQ(box({2, 1, 1}, {1, 2, 3}, 40), "Turn no-go box");
    EXPECT_EQ(box({2, 1.5, 1}, {1, 3, 3}, 40), "Resize no-go box");
    EXPECT_EQ(box({2, 1, 1}, {1, 3, 3}, 10), "Move and turn no-go box");
    const auto view = [&](const json& position, double yaw_deg) {
        return nameOf({{"op", "move_point"},
                       {"point", "view"},
                       {"position", position},
                       {"yaw_deg", yaw_deg}});
    };
    EXPECT_EQ(view({1, 2, 1}, 90), "Move view");
    EXPECT_EQ(view({1, 2, 1}, 45), "Turn view");
    EXPECT_EQ(view({1, 1, 1}, 0), "Move and turn view");
    const json pin = {{"op", "pin"}, {"objects", {"mug"}}, {"position", {1, 1, 1}}};
    json there = pin;
    there["yaw_deg"] = 10;
    EXPECT_EQ(nameOf(there), "Pin the view of mug");
    there["position"] = {1, 2, 1};
    EXPECT_EQ(nameOf(there), "Move the pinned view of mug");
    // The point has the name of its object, but only the point is moved.
    const json moved = {{"op", "move_point"}, {"point", "mug"}, {"position", {1, 2.5, 1}}};
    EXPECT_EQ(nameOf(moved), "Move the pinned view of mug");
    EXPECT_EQ(nameOf({{"op", "unpin"}, {"point", "mug"}}), "Unpin the view of mug");
}

TEST(Operation, NamesEachThingThatIsAnotherInARegion) {
    Editing editing;
    ASSERT_TRUE(editing.apply(
        {{{"op", "add_region"}, {"name", "altar"}, {"center", {1, 1, 1}}, {"size", {1, 1, 1}}}}));
    const auto nameOf = [&](json change) {
        change["op"] = "change_region";
        change["name"] = editing.state.edits.plan.regions[0].name;
        return editing.apply(json::array({change}))->front();
    };
    EXPECT_EQ(nameOf({{"center", {2, 1, 1}}}), "Move altar");
    EXPECT_EQ(nameOf({{"size", {2, 1, 1}}}), "Resize altar");
    EXPECT_EQ(nameOf({{"yaw_deg", 20}}), "Turn altar");
    EXPECT_EQ(nameOf({{"weight", 2.5}}), "Set the weight of altar to 2.5");
    EXPECT_EQ(nameOf({{"must_see", true}}), "Require all of altar to be seen");
    EXPECT_EQ(nameOf({{"must_see", false}, {"weight", 1}}),
              "Set the weight of altar to 1, No longer require all of altar to be seen");
    EXPECT_EQ(nameOf({{"to", "choir"}}), "Rename altar to choir");
}

}  // namespace dollytrack::plan_operations_test
