#include "ui/panels/selection/selection_panel.h"

#include "engine/document/apply_scene_edits.h"
#include "engine/document/operation.h"
#include "engine/document/regroup.h"
#include "tests/support/scene_builder.h"
#include "tests/ui/screen.h"
#include "ui/panels/selection/selection_details.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <numbers>

namespace dollytrack::ui::selection_panel_test {
namespace {

using Kind = Selection::Kind;
using nlohmann::json;

int idOf(const Scene& scene, const std::string& name) {
    for (const Object& object : scene.objects) {
        if (object.name == name) return object.id;
    }
    return 0;
}

Candidate candidate(Verdict verdict, double visible, int occluder = 0) {
    Candidate made;
    made.position = {1.0, 1.0, 1.4};
    made.fill = 0.6;
    made.visible_fraction = visible;
    made.verdict = verdict;
    made.occluder = occluder;
    return made;
}

/// The panel over a furnished room with a small plan made by hand: the sofa has a position point,
/// mug and book have none. The panel's operations are applied at once, as in the editor.
class SelectionPanelTest : public testing::Test {
  protected:
    SelectionPanelTest() {
        ObservationPoint on_sofa;
        on_sofa.position = scene.object(sofa).box.center;
        on_sofa.objects = {sofa};
        ObservationPoint on_table;
        on_table.kind = TargetKind::Support;
        on_table.position = scene.object(mug).box.center;
        on_table.objects = {mug, book};
        on_table.supporter = table;
        plan.observation_points = {on_sofa, on_table};
        plan.searches.resize(2);
        plan.searches[0].candidates = {candidate(Verdict::Legal, 0.95)};
        plan.searches[0].position_point = 0;
        plan.searches[1].candidates = {candidate(Verdict::InObstacle, 0.0),
                                       candidate(Verdict::OccludedBy, 0.3, sofa),
                                       candidate(Verdict::OccludedBy, 0.7, sofa)};
        for (int i = 0; i < 2; ++i) {
            PositionPoint point;
            point.observation_point = i;
            point.pose = lookAt({1.0 + i, 1.5, 1.4}, on_sofa.position);
            point.captured = {sofa};
            point.well_captured = {sofa};
            plan.position_points.push_back(point);
        }
        plan.roadmap.edges = {{0, 1, {}, 1.0}};
        plan.roadmap.refused.resize(1);
        plan.roadmap.refused[0].b = 1;
        plan.roadmap.refused[0].object_id = table;
        plan.trajectory.frames.resize(4);
        plan.trajectory.frames[2].position_point = 0;
        ObjectCapture seen;
        seen.object_id = sofa;
        seen.captured = seen.well_captured = true;
        seen.best = seen.best_well = {sofa, 2, 0.95, 5000.0, 0.2, 0.1};
        ObjectCapture missed;
        missed.object_id = mug;
        missed.best.frame = missed.best_well.frame = -1;
        plan.captures = {seen, missed};
        plan.ledger.resize(2);
        plan.ledger[0].object_id = sofa;
        plan.ledger[0].captured = plan.ledger[0].well_captured = true;
        plan.ledger[0].frame = 2;
        plan.ledger[1].object_id = mug;
        plan.ledger[1].loss = Loss::Occluded;
        plan.ledger[1].occluder = sofa;
        plan.ledger[1].reason = "The sofa hides it from everywhere.";
    }
    void apply(const json& operation) {
        const SetParameter set = [](json&, const std::string&, const json&) { return Status(); };
        const auto done = applyOperation(state, {scene, set}, operation);
        ASSERT_TRUE(done) << describe(done.error()) << " " << operation.dump();
    }
    void draw() {
        SelectionView view;
        view.selection = &selection;
        view.scene = &scene;
        view.plan = &plan;
        view.measured = true;
        view.edits = &state.edits;
        view.track_time_s = track_time_s;
        if (!piece_sizes_m.empty()) view.piece_sizes_m = &piece_sizes_m;
        const SelectionActions now = drawSelectionPanel(view, memory);
        if (now.edit.asks()) {
            asked.push_back(now.edit);
            apply(now.edit.operation);
        }
        drag_ended = drag_ended || now.edit.ends_merge;
        if (now.select) selected = now.select;
        if (now.go_to_frame >= 0) frame = now.go_to_frame;
        if (now.look_through) looked = now.look_through;
        framed = framed || now.frame;
    }
    void show(const Selection& what) {
        selection = what;
        selected.reset();
        screen.frame(3);
    }
    /// The edits of the only object that was changed.
    [[nodiscard]] const ObjectChange& change() const { return state.edits.scene.changes.at(0); }

    Scene scene = test::furnishedRoom();
    const int sofa = idOf(scene, "sofa");
    const int table = idOf(scene, "table");
    const int mug = idOf(scene, "mug");
    const int book = idOf(scene, "book");
    Plan plan;
    ProjectState state;
    Selection selection;
    SelectionState memory;
    std::vector<EditRequest> asked;
    bool drag_ended = false;
    std::optional<Selection> selected;
    std::optional<Pose> looked;
    int frame = -1;
    bool framed = false;
    double track_time_s = 0.0;
    std::vector<double> piece_sizes_m;
    test::Screen screen{[this] { draw(); }, 340, 1000};
};

TEST_F(SelectionPanelTest, ClassIsFoundByTypingAndEnter) {
    show(Selection::ofObject(sofa));
    ASSERT_TRUE(screen.click("selection.class")) << screen.names();
    screen.type("bathtub");
    screen.press(GLFW_KEY_ENTER);
    EXPECT_EQ(change().nyu40, 36);
    ASSERT_TRUE(screen.click("selection.class"));
    screen.type("chair");
    ASSERT_TRUE(screen.click("selection.class.5")) << screen.names();
    EXPECT_EQ(change().nyu40, 5);
}

TEST_F(SelectionPanelTest, TargetSizeAndResetOfAnObject) {
    show(Selection::ofObject(sofa));
    EXPECT_FALSE(screen.enabled("selection.reset"));
    ASSERT_TRUE(screen.click("selection.target"));
    EXPECT_EQ(change().role, Role::Excluded);
    ASSERT_TRUE(screen.click("selection.size"));
    ASSERT_TRUE(screen.click("selection.size.small")) << screen.names();
    EXPECT_EQ(change().large, false);
    ASSERT_TRUE(screen.click("selection.reset"));
    EXPECT_TRUE(state.edits.scene.changes.empty());
}

TEST_F(SelectionPanelTest, FrontIsTypedInDegreesAndDraggedAsOneStep) {
    show(Selection::ofObject(sofa));
    ASSERT_TRUE(screen.typeInto("selection.front", "90"));
    ASSERT_TRUE(change().front);
    EXPECT_NEAR((*change().front - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-9);
    asked.clear();
    drag_ended = false;
    ASSERT_TRUE(screen.drag("selection.front", 60, 0));
    ASSERT_GT(asked.size(), 1U);
    for (const EditRequest& edit : asked) EXPECT_EQ(edit.merge_key, asked[0].merge_key);
    EXPECT_FALSE(asked[0].merge_key.empty());
    EXPECT_TRUE(drag_ended);
    EXPECT_LT(change().front->x(), -0.1);
}

TEST_F(SelectionPanelTest, MoveAndTurnArePutBackEachByItself) {
    show(Selection::ofObject(sofa));
    EXPECT_FALSE(screen.enabled("selection.move.reset"));
    ASSERT_TRUE(screen.typeInto("selection.move.x", "0.25"));
    ASSERT_TRUE(screen.typeInto("selection.turn", "90"));
    ASSERT_TRUE(screen.click("selection.move.reset"));
    EXPECT_TRUE(change().move->offset_m.isZero(0.0));
    EXPECT_DOUBLE_EQ(change().move->turn_rad, 0.5 * std::numbers::pi);
    ASSERT_TRUE(screen.click("selection.turn.reset"));
    EXPECT_TRUE(state.edits.scene.changes.empty());
}

TEST_F(SelectionPanelTest, KeysAreSetWhereTheObjectIsAndTakenAway) {
    show(Selection::ofObject(sofa));
    EXPECT_FALSE(screen.enabled("selection.remove_key"));
    EXPECT_FALSE(screen.enabled("selection.remove_track"));
    ASSERT_TRUE(screen.click("selection.add_key"));
    track_time_s = 2.5;
    ASSERT_TRUE(screen.typeInto("selection.move.x", "0.25"));
    ASSERT_TRUE(screen.click("selection.add_key"));
    ASSERT_EQ(change().track.size(), 2U);
    EXPECT_EQ(change().track[1], (TrackKey{2.5, {{0.25, 0, 0}, 0.0}}));
    ASSERT_TRUE(screen.click("selection.key.0"));
    EXPECT_EQ(asked.back().operation, (json{{"op", "at_time"}, {"time_s", 0.0}}));
    ASSERT_TRUE(screen.click("selection.remove_key"));
    ASSERT_EQ(change().track.size(), 1U) << "that of 2.5 s is gone";
    EXPECT_EQ(change().track[0].time_s, 0.0);
    ASSERT_TRUE(screen.click("selection.remove_track"));
    EXPECT_TRUE(state.edits.scene.changes.empty());
}

TEST_F(SelectionPanelTest, ASplitTellsItsPiecesAndTakesLimits) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 4, 2.6});
    auto& heap = builder.object("heap");
    for (int i = 0; i < 4; ++i)
        heap.box({1.0 + i, 1, 0.5}, Eigen::Vector3d::Constant(0.5 - 0.1 * i));
    scene = builder.build();
    plan = {};
    piece_sizes_m = pieceSizes(scene, scene.objects.back());
    show(Selection::ofObject(scene.objects.back().id));
    SelectionView told;
    told.piece_sizes_m = &piece_sizes_m;
    EXPECT_EQ(splitText(told, memory.split), "Makes 4 objects of it, the smallest 0.2 m");
    ASSERT_TRUE(screen.typeInto("selection.split.min_size_m", "0.35")) << screen.names();
    EXPECT_EQ(splitText(told, memory.split),
              "Makes 2 objects of it, the smallest 0.4 m; 2 smaller pieces join the nearest");
    ASSERT_TRUE(screen.typeInto("selection.split.min_size_m", "0.45"));
    EXPECT_FALSE(screen.enabled("selection.split"));
    ASSERT_TRUE(screen.typeInto("selection.split.min_size_m", "0"));
    ASSERT_TRUE(screen.typeInto("selection.split.max_pieces", "3"));
    ASSERT_TRUE(screen.click("selection.split"));
    EXPECT_EQ(asked.back().operation["max_pieces"], 3);
    EXPECT_EQ(applySceneEdits(scene, state.edits.scene)->objects.size(), scene.objects.size() + 2);
}

TEST_F(SelectionPanelTest, CapturedObjectLeadsToItsFrameAndPoint) {
    show(Selection::ofObject(sofa));
    ASSERT_TRUE(screen.click("selection.best_frame")) << screen.names();
    EXPECT_EQ(frame, 2);
    ASSERT_TRUE(screen.click("selection.position_point"));
    EXPECT_EQ(selected, Selection::ofItem(Kind::PositionPoint, 0));
    ASSERT_TRUE(screen.click("selection.frame"));
    EXPECT_TRUE(framed);
}

TEST_F(SelectionPanelTest, UncapturedObjectLeadsToItsCandidates) {
    show(Selection::ofObject(mug));
    EXPECT_FALSE(screen.shows("selection.best_frame"));
    ASSERT_TRUE(screen.click("selection.show_candidates"));
    EXPECT_FALSE(memory.show_candidates);
    // "Hidden by the sofa" comes first: two candidates of three.
    ASSERT_TRUE(screen.click("selection.outcome.0")) << screen.names();
    EXPECT_EQ(selected, Selection::ofCandidate(1, 2));
    ASSERT_TRUE(screen.click("selection.outcome.0.occluder"));
    EXPECT_EQ(selected, Selection::ofObject(sofa));
    ASSERT_TRUE(screen.click("selection.best_candidate"));
    EXPECT_EQ(selected, Selection::ofCandidate(1, 2));
}

TEST_F(SelectionPanelTest, SeveralObjectsAreMerged) {
    show({Kind::Objects, {mug, book}});
    EXPECT_FALSE(screen.enabled("selection.merge"));
    ASSERT_TRUE(screen.click("selection.merge_name"));
    screen.type("still life");
    ASSERT_TRUE(screen.click("selection.merge")) << screen.names();
    ASSERT_EQ(state.edits.scene.definitions.size(), 1U);
    EXPECT_EQ(state.edits.scene.definitions[0].name, "still life");
    EXPECT_EQ(state.edits.scene.definitions[0].objects.size(), 2U);
}

TEST_F(SelectionPanelTest, SeveralObjectsAreGroupedByWhatTouches) {
    show({Kind::Objects, {sofa, table, mug, book}});
    ASSERT_TRUE(screen.click("selection.group")) << screen.names();
    ASSERT_EQ(state.edits.scene.definitions.size(), 1U) << "mug and book stand on the table";
    EXPECT_EQ(state.edits.scene.definitions[0].objects.size(), 3U);
    EXPECT_EQ(state.edits.scene.definitions[0].name, "table");
}

TEST_F(SelectionPanelTest, CandidateIsLookedThroughAndPinned) {
    show(Selection::ofCandidate(1, 2));
    ASSERT_TRUE(screen.click("selection.look")) << screen.names();
    ASSERT_TRUE(looked);
    EXPECT_EQ(looked->position, Eigen::Vector3d(1.0, 1.0, 1.4));
    ASSERT_TRUE(screen.click("selection.pin"));
    ASSERT_EQ(state.edits.plan.pinned.size(), 1U);
    EXPECT_EQ(state.edits.plan.pinned[0].pose.position, Eigen::Vector3d(1.0, 1.0, 1.4));
    EXPECT_EQ(state.edits.plan.pinned[0].objects.size(), 2U);
}

TEST_F(SelectionPanelTest, LockingKeepsThePoseToTheLastBit) {
    show(Selection::ofItem(Kind::PositionPoint, 0));
    ASSERT_TRUE(screen.click("selection.pin")) << screen.names();
    ASSERT_EQ(state.edits.plan.pinned.size(), 1U);
    EXPECT_EQ(state.edits.plan.pinned[0].pose, plan.position_points[0].pose);
    ASSERT_TRUE(screen.click("selection.unpin"));
    EXPECT_TRUE(state.edits.plan.pinned.empty());
}

TEST_F(SelectionPanelTest, DraggingAPointMovesItSteadilyWhileThePlanIsOld) {
    show(Selection::ofItem(Kind::PositionPoint, 0));
    ASSERT_TRUE(screen.drag("selection.position.x", 50, 0)) << screen.names();
    ASSERT_EQ(state.edits.plan.pinned.size(), 1U);
    const Pose& pose = state.edits.plan.pinned[0].pose;
    const Pose& before = plan.position_points[0].pose;
    EXPECT_GT(pose.position.x(), before.position.x() + 0.3);
    EXPECT_EQ(pose.position.tail<2>(), before.position.tail<2>());
    EXPECT_LT(angleBetween(pose.rotation, before.rotation), 1e-12);
    EXPECT_TRUE(drag_ended);
}

TEST_F(SelectionPanelTest, TurningAPointLeavesItsPlace) {
    show(Selection::ofItem(Kind::PositionPoint, 0));
    ASSERT_TRUE(screen.typeInto("selection.yaw", "30"));
    ASSERT_TRUE(screen.typeInto("selection.pitch", "-10"));
    ASSERT_EQ(state.edits.plan.pinned.size(), 1U);
    const Pose& pose = state.edits.plan.pinned[0].pose;
    EXPECT_EQ(pose.position, plan.position_points[0].pose.position);
    const double degree = std::acos(-1.0) / 180.0;
    EXPECT_NEAR(std::atan2(pose.forward().y(), pose.forward().x()), 30 * degree, 1e-6);
    EXPECT_NEAR(std::asin(pose.forward().z()), -10 * degree, 1e-6);
}

TEST_F(SelectionPanelTest, PositionPointLeadsOnAndIsDeleted) {
    show(Selection::ofItem(Kind::PositionPoint, 0));
    ASSERT_TRUE(screen.click("selection.well." + std::to_string(sofa))) << screen.names();
    EXPECT_EQ(selected, Selection::ofObject(sofa));
    ASSERT_TRUE(screen.click("selection.go_to_frame"));
    EXPECT_EQ(frame, 2);
    ASSERT_TRUE(screen.click("selection.delete"));
    EXPECT_EQ(state.edits.plan.removed.size(), 1U);
}

TEST_F(SelectionPanelTest, APointPlacedFromAViewIsMovedByItsName) {
    apply({{"op", "add_point"}, {"position", {2.0, 1.0, 1.5}}, {"yaw_deg", 30.0}});
    plan.position_points[1].pin = 0;
    show(Selection::ofItem(Kind::PositionPoint, 1));
    ASSERT_TRUE(screen.typeInto("selection.position.z", "1.75")) << screen.names();
    ASSERT_EQ(state.edits.plan.pinned.size(), 1U);
    EXPECT_EQ(state.edits.plan.pinned[0].pose.position, Eigen::Vector3d(2.0, 1.0, 1.75));
    EXPECT_FALSE(screen.enabled("selection.pin"));
    ASSERT_TRUE(screen.click("selection.delete"));
    EXPECT_TRUE(state.edits.plan.pinned.empty());
    EXPECT_TRUE(state.edits.plan.removed.empty());
}

TEST_F(SelectionPanelTest, ObservationPointIsRemovedAndRestored) {
    show(Selection::ofItem(Kind::ObservationPoint, 1));
    ASSERT_TRUE(screen.click("selection.carrier")) << screen.names();
    EXPECT_EQ(selected, Selection::ofObject(table));
    ASSERT_TRUE(screen.click("selection.remove"));
    EXPECT_EQ(state.edits.plan.removed.size(), 1U);
    ASSERT_TRUE(screen.click("selection.restore"));
    EXPECT_TRUE(state.edits.plan.removed.empty());
}

TEST_F(SelectionPanelTest, EdgesLeadToTheirEndsAndToWhatTheyHit) {
    show(Selection::ofItem(Kind::Edge, 0));
    ASSERT_TRUE(screen.click("selection.to")) << screen.names();
    EXPECT_EQ(selected, Selection::ofItem(Kind::PositionPoint, 1));
    show(Selection::ofItem(Kind::RefusedEdge, 0));
    ASSERT_TRUE(screen.click("selection.hit"));
    EXPECT_EQ(selected, Selection::ofObject(table));
}

TEST_F(SelectionPanelTest, FrameLeadsToItsPoint) {
    show(Selection::ofItem(Kind::Frame, 2));
    ASSERT_TRUE(screen.click("selection.position_point")) << screen.names();
    EXPECT_EQ(selected, Selection::ofItem(Kind::PositionPoint, 0));
    ASSERT_TRUE(screen.click("selection.object." + std::to_string(sofa)));
    EXPECT_EQ(selected, Selection::ofObject(sofa));
}

TEST_F(SelectionPanelTest, NoGoBoxIsResizedAndDeleted) {
    apply({{"op", "add_no_go"}, {"center", {2.0, 1.5, 1.0}}, {"size", {1.0, 0.5, 2.0}}});
    show(Selection::ofItem(Kind::NoGoBox, 0));
    ASSERT_TRUE(screen.typeInto("selection.box.size.x", "0.5")) << screen.names();
    EXPECT_DOUBLE_EQ(state.edits.plan.no_go[0].box.half_size.x(), 0.25);
    ASSERT_TRUE(screen.click("selection.delete"));
    EXPECT_TRUE(state.edits.plan.no_go.empty());
}

TEST_F(SelectionPanelTest, NoGoBoxIsRenamedWhenItsNameIsWhole) {
    apply({{"op", "add_no_go"}, {"center", {2.0, 1.5, 1.0}}, {"size", {1.0, 0.5, 2.0}}});
    show(Selection::ofItem(Kind::NoGoBox, 0));
    const auto name = [&] { return state.edits.plan.no_go[0].name; };
    ASSERT_TRUE(screen.click("selection.box.name")) << screen.names();
    screen.type("stairs");
    EXPECT_EQ(name(), "no-go box");
    screen.press(GLFW_KEY_ENTER);
    EXPECT_EQ(name(), "stairs");
    screen.click("selection.box.name");
    screen.type("else");
    screen.press(GLFW_KEY_ESCAPE);
    EXPECT_EQ(name(), "stairs");
    screen.click("selection.box.name");
    screen.type("well");
    screen.click("selection.frame");  // clicking another widget confirms it as Enter does
    EXPECT_EQ(name(), "well");
}

TEST_F(SelectionPanelTest, RegionIsWeighedAndDeleted) {
    apply({{"op", "add_region"}, {"center", {2.0, 1.5, 1.0}}, {"size", {1.0, 0.5, 2.0}}});
    show(Selection::ofItem(Kind::Region, 0));
    ASSERT_TRUE(screen.typeInto("selection.region.weight", "3")) << screen.names();
    EXPECT_EQ(state.edits.plan.regions[0].weight, 3.0);
    ASSERT_TRUE(screen.click("selection.region.must_see"));
    EXPECT_TRUE(state.edits.plan.regions[0].must_see);
    ASSERT_TRUE(screen.click("selection.delete"));
    EXPECT_TRUE(state.edits.plan.regions.empty());
}

TEST_F(SelectionPanelTest, WhatIsGoneFromThePlanShowsNothing) {
    for (const Kind kind :
         {Kind::ObservationPoint, Kind::PositionPoint, Kind::Edge, Kind::RefusedEdge, Kind::Frame,
          Kind::NoGoBox, Kind::Region, Kind::Voxel}) {
        show(Selection::ofItem(kind, 99));
        EXPECT_TRUE(screen.names().empty()) << screen.names();
    }
    show(Selection::ofCandidate(1, 99));
    EXPECT_TRUE(screen.names().empty());
    show(Selection::ofObject(999));
    EXPECT_TRUE(screen.names().empty());
}

}  // namespace
}  // namespace dollytrack::ui::selection_panel_test
