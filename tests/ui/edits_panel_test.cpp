#include "ui/panels/edits/edits_panel.h"

#include "engine/document/operation.h"
#include "tests/support/scene_builder.h"
#include "tests/ui/screen.h"

#include <gtest/gtest.h>

namespace dollytrack::ui::edits_panel_test {
namespace {

using nlohmann::json;

/// The panel for a furnished room. Its operations are applied at once, as in the editor, so that an
/// operation that the document would refuse fails the test.
class EditsPanelTest : public testing::Test {
  protected:
    EditsPanelTest() {
        apply({{"op", "exclude"}, {"object", "sofa"}});
        apply({{"op", "pin"},
               {"objects", json::array({"picture"})},
               {"position", {1.0, 1.0, 1.5}},
               {"target", {1.0, 3.0, 1.5}}});
        apply({{"op", "add_point"}, {"position", {2.0, 1.0, 1.5}}, {"yaw_deg", 30.0}});
        apply({{"op", "remove_point"}, {"objects", json::array({"table"})}});
        apply({{"op", "add_no_go"}, {"center", {2.0, 1.5, 1.0}}, {"size", {1.0, 0.5, 2.0}}});
        screen.frame(2);
    }
    void apply(const json& operation) {
        const SetParameter set = [](json& parameters, const std::string& name, const json& value) {
            parameters["free_space"][name] = value;
            return Status();
        };
        const auto done = applyOperation(state, {scene, set}, operation);
        ASSERT_TRUE(done) << describe(done.error()) << " " << operation.dump();
    }
    void draw() {
        EditsView view;
        view.edits = &state.edits;
        view.scene = &scene;
        view.plan = &plan;
        view.plan_is_current = true;
        view.new_box = {{1.0, 2.0, 0.5}, Eigen::Vector3d::Constant(0.5), 0.0};
        view.around_selection = around;
        const json heights = state.parameters.value("free_space", json::object());
        view.min_height_m = heights.value("min_height_m", 0.0);
        view.max_height_m = heights.value("max_height_m", 100.0);
        view.motion = motion;
        if (state.edits.plan.motion) view.motion.motion = &*state.edits.plan.motion;
        view.motion.plan = &plan;
        const EditsActions now = drawEditsPanel(view, move);
        if (now.motion.edit.asks()) apply(now.motion.edit.operation);
        repairs = repairs || now.motion.repair;
        fits = fits || now.motion.fit_keys;
        adds_key = adds_key || now.motion.add_key;
        if (now.motion.select_key >= 0) selected_key = now.motion.select_key;
        if (now.motion.look_through) looked = now.motion.look_through;
        made += now.motion.move.make ? 1 : 0;
        if (now.motion.free_key) freed = static_cast<int>(*now.motion.free_key);
        if (now.motion.collision != 0) collision = now.motion.collision;
        replaces_key = replaces_key || now.motion.replace_key;
        if (now.edit.asks()) {
            asked.push_back(now.edit);
            apply(now.edit.operation);
        }
        drag_ended = drag_ended || now.edit.ends_merge;
        if (now.select) selected = now.select;
        if (now.look_through) looked = now.look_through;
        if (now.frame) framed = now.frame;
    }
    Scene scene = test::furnishedRoom();
    Plan plan;
    ProjectState state;
    std::optional<OrientedBox> around;
    MotionView motion;
    bool repairs = false;
    bool fits = false;
    bool adds_key = false;
    int selected_key = -1;
    MoveDraft move;
    int made = 0;  // moves
    int freed = -1;
    int collision = 0;
    bool replaces_key = false;
    std::vector<EditRequest> asked;
    bool drag_ended = false;
    std::optional<Selection> selected;
    std::optional<Pose> looked;
    std::optional<OrientedBox> framed;
    test::Screen screen{[this] { draw(); }, 340, 900};
};

TEST_F(EditsPanelTest, ResetTakesBackWhatWasSaidOfAnObject) {
    const int sofa = state.edits.scene.changes.front().object.id;
    const std::string name = "edits.object." + std::to_string(sofa);
    ASSERT_TRUE(screen.click(name + ".select")) << screen.names();
    EXPECT_EQ(selected, Selection::ofObject(sofa));
    ASSERT_TRUE(screen.click(name + ".reset"));
    EXPECT_TRUE(state.edits.scene.changes.empty());
    EXPECT_FALSE(screen.shows(name + ".reset"));
}

TEST_F(EditsPanelTest, AGivenMotionIsRepairedOrPlannedAgain) {
    EXPECT_FALSE(screen.shows("edits.motion.repair"));
    apply({{"op", "set_motion"},
           {"frames", {{0.0, 1, 1, 1, 0, 0, 0, 1}, {0.1, 2, 1, 1, 0, 0, 0, 1}}}});
    screen.frame(2);
    ASSERT_TRUE(screen.click("edits.motion.repair")) << screen.names();
    EXPECT_TRUE(repairs);
    ASSERT_TRUE(screen.click("edits.motion.clear"));
    EXPECT_FALSE(state.edits.plan.motion);
    EXPECT_FALSE(screen.shows("edits.motion.clear"));
}

TEST_F(EditsPanelTest, KeysOfTheCameraPathAreRetimedGoneToAndRemoved) {
    for (const double time_s : {0.0, 2.0, 4.0}) {
        apply({{"op", "add_camera_key"},
               {"time_s", time_s},
               {"position", {1.0, 1.0 + 0.1 * time_s, 1.5}},
               {"target", {2.0, 1.0, 1.0}}});
    }
    plan.passed_keys = {
        {0, 0.0, ""}, {30, 3.0, "Key 2 is reached at 3 s instead of 2 s."}, {40, 4.0, ""}};
    screen.frame(2);
    EXPECT_FALSE(screen.shows("edits.motion.repair")) << screen.names();
    ASSERT_TRUE(screen.typeInto("edits.motion.key.1.time", "2.5"));
    EXPECT_EQ(state.edits.plan.motion->keys[1].time_s, 2.5);
    ASSERT_TRUE(screen.typeInto("edits.motion.key.1.time", "9"));
    EXPECT_LT(state.edits.plan.motion->keys[1].time_s, 4.0) << "the order stays";
    ASSERT_TRUE(screen.click("edits.motion.key.2.go_to"));
    EXPECT_EQ(looked, state.edits.plan.motion->keys[2].pose);
    ASSERT_TRUE(screen.click("edits.motion.key.0.select"));
    EXPECT_EQ(selected_key, 0);
    EXPECT_FALSE(screen.shows("edits.motion.fit_keys")) << "the camera is in time now";
    plan.passed_keys[1].time_s = 6.0;
    screen.frame(2);
    ASSERT_TRUE(screen.click("edits.motion.fit_keys"));
    EXPECT_TRUE(fits);
    ASSERT_TRUE(screen.click("edits.motion.key.0.delete"));
    EXPECT_EQ(state.edits.plan.motion->keys.size(), 2U);
    ASSERT_TRUE(screen.click("edits.motion.add_key"));
    EXPECT_TRUE(adds_key);
    ASSERT_TRUE(screen.click("edits.motion.replace_key"));
    EXPECT_TRUE(replaces_key);
    motion.why_no_key = "No scene is open.";
    screen.frame(2);
    EXPECT_FALSE(screen.enabled("edits.motion.add_key"));
}

TEST_F(EditsPanelTest, AMoveIsSetUpInAForm) {
    motion.move.why_not = "No scene is open.";
    screen.frame(2);
    EXPECT_FALSE(screen.shows("edits.move.make"));
    ASSERT_TRUE(screen.click("edits.motion.orbit"));
    screen.frame(2);
    EXPECT_FALSE(screen.enabled("edits.move.make"));
    motion.move.why_not.clear();
    motion.move.eye = {1.0, 2.0, 1.5};
    screen.frame(2);
    ASSERT_TRUE(screen.click("edits.motion.crane"));
    ASSERT_TRUE(screen.click("edits.move.to_height.set"));
    screen.frame(2);
    ASSERT_TRUE(screen.typeInto("edits.move.to_height", "2.25"));
    ASSERT_TRUE(screen.click("edits.move.make"));
    EXPECT_EQ(planning::moveText(move.request()), "crane:to_height=2.25");
    ASSERT_TRUE(screen.click("edits.motion.walk"));
    ASSERT_TRUE(screen.click("edits.move.from.set"));
    ASSERT_TRUE(screen.click("edits.move.make"));
    EXPECT_EQ(planning::moveText(move.request()), "walk:from=1;2;1.5");
    EXPECT_EQ(made, 2);
    ASSERT_TRUE(screen.click("edits.motion.crane"));
    EXPECT_TRUE(screen.shows("edits.move.to_height")) << "each kind keeps its settings";
    ASSERT_TRUE(screen.click("edits.move.to_height.set"));
    EXPECT_EQ(planning::moveText(move.request()), "crane");
    ASSERT_TRUE(screen.click("edits.move.close"));
    screen.frame(2);
    EXPECT_FALSE(screen.shows("edits.move.make"));
}

// The form has a widget for every setting that the command line accepts.
TEST_F(EditsPanelTest, EverySettingOfAMoveHasAWidget) {
    for (const planning::MoveKind& kind : planning::moveKinds()) {
        ASSERT_TRUE(screen.click("edits.motion." + std::string(kind.name)));
        screen.frame(2);
        for (const planning::MoveSetting& setting : kind.settings) {
            const bool is_object = setting.kind == planning::MoveSetting::Kind::Object;
            EXPECT_TRUE(
                screen.shows("edits.move." + std::string(setting.name) + (is_object ? "" : ".set")))
                << kind.name << " " << setting.name;
        }
    }
}

TEST_F(EditsPanelTest, BlockedKeysAndCollisionsAreReported) {
    apply({{"op", "add_camera_key"},
           {"time_s", 0.0},
           {"position", {1.0, 1.0, 1.5}},
           {"target", {2.0, 1.0, 1.0}}});
    plan.passed_keys = {{0, 0.0, ""}};
    motion.key_states = {{"is in or too close to 'wall'", Eigen::Vector3d(1.0, 1.5, 1.5)}};
    screen.frame(2);
    EXPECT_FALSE(screen.shows("edits.motion.collisions"));
    ASSERT_TRUE(screen.click("edits.motion.key.0.free")) << screen.names();
    EXPECT_EQ(freed, 0);
    plan.smooth_paths.emplace_back().collisions = 1;
    screen.frame(2);
    ASSERT_TRUE(screen.click("edits.motion.collisions"));
    EXPECT_EQ(collision, 1);
    ASSERT_TRUE(screen.click("edits.motion.previous_collision"));
    EXPECT_EQ(collision, -1);
}

TEST_F(EditsPanelTest, PinsCanBeLookedThroughAndUnpinned) {
    const Pose pose = state.edits.plan.pinned[0].pose;
    ASSERT_TRUE(screen.click("edits.pin.0.look")) << screen.names();
    EXPECT_EQ(looked, pose);
    ASSERT_TRUE(screen.click("edits.pin.0.unpin"));
    ASSERT_EQ(state.edits.plan.pinned.size(), 1U);
    EXPECT_TRUE(state.edits.plan.pinned[0].objects.empty());
}

TEST_F(EditsPanelTest, RemovedPointsCanBeRestored) {
    ASSERT_TRUE(screen.click("edits.removed.0.restore")) << screen.names();
    EXPECT_TRUE(state.edits.plan.removed.empty());
}

TEST_F(EditsPanelTest, DraggingABoxIsOneMergeOfManyMoves) {
    const double before = state.edits.plan.no_go[0].box.center.x();
    ASSERT_TRUE(screen.drag("edits.box.0.center.x", 50, 0)) << screen.names();
    ASSERT_GT(asked.size(), 1U);
    for (const EditRequest& edit : asked) {
        EXPECT_EQ(edit.operation["op"], "move_no_go");
        EXPECT_EQ(edit.merge_key, asked.front().merge_key);
        EXPECT_FALSE(edit.merge_key.empty());
    }
    EXPECT_TRUE(drag_ended);
    EXPECT_GT(state.edits.plan.no_go[0].box.center.x(), before + 0.1);
    EXPECT_DOUBLE_EQ(state.edits.plan.no_go[0].box.center.y(), 1.5);
}

TEST_F(EditsPanelTest, ATypedSizeAndTurnArriveExactly) {
    ASSERT_TRUE(screen.typeInto("edits.box.0.size.z", "1.25"));
    EXPECT_DOUBLE_EQ(state.edits.plan.no_go[0].box.half_size.z(), 0.625);
    ASSERT_TRUE(screen.typeInto("edits.box.0.yaw", "45"));
    EXPECT_NEAR(state.edits.plan.no_go[0].box.yaw, std::acos(-1.0) / 4, 1e-12);
}

TEST_F(EditsPanelTest, BoxesAreAddedGoneToAndDeleted) {
    ASSERT_TRUE(screen.click("edits.add_box")) << screen.names();
    ASSERT_EQ(state.edits.plan.no_go.size(), 2U);
    EXPECT_EQ(state.edits.plan.no_go[1].box.center, Eigen::Vector3d(1.0, 2.0, 0.5));
    EXPECT_FALSE(screen.enabled("edits.add_box_around"));
    around = scene.object(1).box;
    screen.frame(2);
    ASSERT_TRUE(screen.click("edits.add_box_around"));
    ASSERT_EQ(state.edits.plan.no_go.size(), 3U);
    // The floor has no thickness, but the box around it must have some.
    const OrientedBox& box = state.edits.plan.no_go[2].box;
    EXPECT_EQ(box.center, around->center);
    EXPECT_EQ(box.half_size.head<2>(), around->half_size.head<2>());
    EXPECT_GT(box.half_size.z(), 0.01);
    ASSERT_TRUE(screen.click("edits.box.0.go_to"));
    EXPECT_EQ(framed, state.edits.plan.no_go[0].box);
    ASSERT_TRUE(screen.click("edits.box.0.delete"));
    EXPECT_EQ(state.edits.plan.no_go.size(), 2U);
}

TEST_F(EditsPanelTest, HeightBandIsTypedAndTakenBack) {
    EXPECT_FALSE(screen.shows("edits.height.reset"));
    ASSERT_TRUE(screen.typeInto("edits.height.max", "1.8")) << screen.names();
    ASSERT_TRUE(screen.typeInto("edits.height.min", "0.5"));
    EXPECT_EQ(state.parameters["free_space"]["min_height_m"], 0.5);
    EXPECT_EQ(state.parameters["free_space"]["max_height_m"], 1.8);
    ASSERT_TRUE(screen.click("edits.height.reset"));
    EXPECT_EQ(state.parameters["free_space"]["max_height_m"], 100.0);
}

TEST_F(EditsPanelTest, ALowerEndAboveTheUpperOneIsKeptOut) {
    ASSERT_TRUE(screen.typeInto("edits.height.max", "1.8"));
    ASSERT_TRUE(screen.typeInto("edits.height.min", "5"));
    EXPECT_LT(state.parameters["free_space"]["min_height_m"].get<double>(), 1.8);
}

TEST_F(EditsPanelTest, TargetListsAreTypedAndEmptied) {
    ASSERT_TRUE(screen.typeInto("edits.ignore", "lamp*,  chair ,")) << screen.names();
    EXPECT_EQ(state.edits.scene.ignore, (std::vector<std::string>{"lamp*", "chair"}));
    ASSERT_TRUE(screen.typeInto("edits.only", "sofa"));
    EXPECT_EQ(state.edits.scene.only, std::vector<std::string>{"sofa"});
    ASSERT_TRUE(screen.typeInto("edits.ignore", " "));
    EXPECT_TRUE(state.edits.scene.ignore.empty());
}

TEST_F(EditsPanelTest, ATrajectoryBeginsAndEndsAtPinnedPoints) {
    ASSERT_TRUE(screen.click("edits.pin.0.set_start")) << screen.names();
    EXPECT_EQ(state.edits.plan.start, state.edits.plan.pinned[0].name);
    ASSERT_TRUE(screen.click("edits.pin.1.set_end"));
    EXPECT_EQ(state.edits.plan.end, state.edits.plan.pinned[1].name);
    ASSERT_TRUE(screen.click("edits.pin.0.set_start"));
    EXPECT_EQ(state.edits.plan.start, "");
}

TEST_F(EditsPanelTest, RegionsAreAddedWeighedAndDeleted) {
    ASSERT_TRUE(screen.click("edits.add_region")) << screen.names();
    ASSERT_EQ(state.edits.plan.regions.size(), 1U);
    EXPECT_EQ(state.edits.plan.regions[0].box.center, Eigen::Vector3d(1.0, 2.0, 0.5));
    screen.frame(2);
    ASSERT_TRUE(screen.typeInto("edits.region.0.weight", "7.5"));
    EXPECT_EQ(state.edits.plan.regions[0].weight, 7.5);
    ASSERT_TRUE(screen.click("edits.region.0.must_see"));
    EXPECT_TRUE(state.edits.plan.regions[0].must_see);
    ASSERT_TRUE(screen.typeInto("edits.region.0.size.z", "1.25"));
    EXPECT_DOUBLE_EQ(state.edits.plan.regions[0].box.half_size.z(), 0.625);
    ASSERT_TRUE(screen.typeInto("edits.region.0.name", "altar"));
    EXPECT_EQ(state.edits.plan.regions[0].name, "altar");
    ASSERT_TRUE(screen.click("edits.region.0.delete"));
    EXPECT_TRUE(state.edits.plan.regions.empty());
}

}  // namespace
}  // namespace dollytrack::ui::edits_panel_test
