#include "app/editor/objects/selection_tracker.h"

#include <gtest/gtest.h>

#include <memory>

namespace dollytrack::editor::selection_tracker_test {
namespace {

using ui::Selection;
using Kind = Selection::Kind;
using Trace = std::shared_ptr<const ObjectTrace>;

// Six triangles in five objects; then 2 and 4 are merged into object 2; then 3 is split into two.
const Trace kFile = std::make_shared<const ObjectTrace>(ObjectTrace{1, 2, 3, 3, 4, 5});
const Trace kMerged = std::make_shared<const ObjectTrace>(ObjectTrace{1, 2, 3, 3, 2, 4});
const Trace kSplit = std::make_shared<const ObjectTrace>(ObjectTrace{1, 2, 3, 4, 2, 5});

Selection objects(std::vector<int> ids) {
    Selection selection;
    selection.kind = ids.size() == 1 ? Kind::Object : Kind::Objects;
    selection.objects = std::move(ids);
    return selection;
}

SelectionTracker selecting(std::vector<int> ids, const Trace& trace) {
    SelectionTracker selected;
    selected.follow(trace);
    selected.set(objects(std::move(ids)), nullptr, {});
    return selected;
}

TEST(SelectionTracker, AddsAndTakesOutObjects) {
    const SelectionTracker selected = selecting({2, 5}, kFile);
    EXPECT_EQ(selected.withObjects({3, 5}, true), objects({2, 5, 3}));
    EXPECT_EQ(selected.withObjects({3}, false), objects({3}));
    EXPECT_EQ(selected.withoutObjects({5, 4}), objects({2}));
    EXPECT_EQ(selected.withoutObjects({2, 5}), Selection());
}

TEST(SelectionTracker, FollowsAnObjectThatGetsAnotherNumber) {
    SelectionTracker selected = selecting({5}, kFile);
    selected.follow(kMerged);
    EXPECT_EQ(selected.now(), objects({4}));
    selected.follow(kSplit);
    EXPECT_EQ(selected.now(), objects({5}));
    selected.follow(kFile);
    EXPECT_EQ(selected.now(), objects({5}));
}

TEST(SelectionTracker, TheNewObjectAloneIsSelectedAfterMergingAndItsPartsAfterUndo) {
    SelectionTracker selected = selecting({2, 4}, kFile);
    selected.follow(kMerged);
    EXPECT_EQ(selected.now(), objects({2}));
    selected.follow(kFile);
    EXPECT_EQ(selected.now(), objects({2, 4}));
}

TEST(SelectionTracker, ThePiecesAreSelectedAfterSplitting) {
    SelectionTracker selected = selecting({3}, kMerged);
    selected.follow(kSplit);
    EXPECT_EQ(selected.now(), objects({3, 4}));
    selected.follow(kMerged);
    EXPECT_EQ(selected.now(), objects({3}));
}

TEST(SelectionTracker, TheLocalViewShowsTheSelectionUntilItEnds) {
    SelectionTracker selected = selecting({5}, kFile);
    selected.toggleLocalView();
    EXPECT_EQ(selected.leftOut(), (std::vector<bool>{true, true, true, true, true, false}));
    selected.follow(kMerged);
    EXPECT_EQ(selected.leftOut(), (std::vector<bool>{true, true, true, true, false}));
    selected.clear();
    EXPECT_TRUE(selected.inLocalView()) << "of what was selected when it began";
    selected.toggleHidden(4);
    EXPECT_TRUE(selected.leftOut()[4]) << "hidden objects stay hidden in it";
    selected.toggleLocalView();
    EXPECT_EQ(selected.leftOut(), selected.hidden());
}

TEST(SelectionTracker, HiddenObjectsStayHiddenUnderTheirNewNumbers) {
    SelectionTracker selected = selecting({}, kFile);
    selected.toggleHidden(5);
    selected.toggleHidden(2);
    selected.follow(kMerged);  // 4 was visible, so the merged object is
    EXPECT_EQ(selected.hidden(), (std::vector<bool>{false, false, false, false, true}));
    selected.forget();
    selected.follow(kFile);
    EXPECT_EQ(selected.hidden(), std::vector<bool>(6, false));
}

/// A plan with a point found by the search, one pinned for the same observation point's
/// neighbour, and one placed from a view.
struct Planned {
    std::vector<PinnedPoint> pinned;
    Plan plan;

    explicit Planned(std::vector<std::string> names) {
        plan.observation_points.resize(1);
        plan.observation_points[0].objects = {5};
        plan.position_points.resize(1);
        for (const std::string& name : names) {
            pinned.push_back({name, {}, {}});
            PositionPoint point;
            point.observation_point = -1;
            point.pin = static_cast<int>(pinned.size()) - 1;
            plan.position_points.push_back(point);
        }
    }
};

Selection positionPoint(int index) {
    return Selection::ofItem(Kind::PositionPoint, index);
}

TEST(SelectionTracker, APointPlacedFromAViewStaysSelectedInTheNextPlan) {
    const Planned before({"view", "view 2"});
    SelectionTracker selected;
    selected.set(positionPoint(2), &before.plan, before.pinned);
    const Planned after({"view 2"});
    EXPECT_TRUE(selected.keepIn(&after.plan, after.pinned));
    EXPECT_EQ(selected.now(), positionPoint(1));
    const Planned without({"view"});
    EXPECT_FALSE(selected.keepIn(&without.plan, without.pinned));
    EXPECT_TRUE(selected.is(Kind::None));
}

TEST(SelectionTracker, ANewPinIsSelectedWhenAPlanHasIt) {
    const Planned before({"view"});
    SelectionTracker selected;
    selected.set(Selection::ofCandidate(0, 7), &before.plan, before.pinned);
    selected.awaitPin("view 2");
    selected.keepIn(&before.plan, before.pinned);  // planned before the pin
    EXPECT_FALSE(selected.is(Kind::PositionPoint));
    const Planned after({"view", "view 2"});
    selected.keepIn(&after.plan, after.pinned);
    EXPECT_EQ(selected.now(), positionPoint(2));
}

// The selection does not jump to the pin when another object was chosen in the meantime.
TEST(SelectionTracker, AnotherChoiceEndsTheWaitForAPin) {
    const Planned after({"view"});
    SelectionTracker selected;
    selected.awaitPin("view");
    selected.set(objects({3}), nullptr, {});
    selected.keepIn(&after.plan, after.pinned);
    EXPECT_EQ(selected.now(), objects({3}));
}

Plan planOf(const std::vector<std::vector<int>>& objects_of_points) {
    Plan plan;
    for (const std::vector<int>& objects : objects_of_points) {
        ObservationPoint point;
        point.objects = objects;
        PositionPoint place;
        place.observation_point = static_cast<int>(plan.observation_points.size());
        plan.observation_points.push_back(point);
        plan.position_points.push_back(place);
    }
    return plan;
}

TEST(SelectionTracker, FindsAPointAgainByWhatItLooksAt) {
    const Plan before = planOf({{1}, {2, 3}, {4}});
    const Plan after = planOf({{5}, {4}, {1}, {2, 3}});
    SelectionTracker selected;
    selected.set(Selection::ofItem(Selection::Kind::PositionPoint, 1), &before, {});
    EXPECT_TRUE(selected.keepIn(&after, {}));
    EXPECT_EQ(selected.now().index, 3);
    EXPECT_EQ(selected.positionPoint(&after), &after.position_points[3]);
    const Plan without = planOf({{5}, {2}});
    EXPECT_FALSE(selected.keepIn(&without, {}));
    EXPECT_TRUE(selected.is(Selection::Kind::None));
}

TEST(SelectionTracker, ForgetsEdgesAndKeepsObjectsInANewPlan) {
    const Plan plan = planOf({{1}});
    SelectionTracker selected;
    selected.set(Selection::ofItem(Selection::Kind::Edge, 0), &plan, {});
    EXPECT_FALSE(selected.keepIn(&plan, {}));
    selected.set(selected.withObject(4, false), &plan, {});
    selected.set(selected.withObject(2, true), &plan, {});
    EXPECT_TRUE(selected.is(Selection::Kind::Objects));
    EXPECT_TRUE(selected.keepIn(nullptr, {}));
    EXPECT_EQ(selected.objects(), (std::vector<int>{4, 2}));
    // The first trace of a project: there is no earlier one to compare with.
    selected.follow(std::make_shared<const ObjectTrace>(ObjectTrace{1, 2, 3}));
    EXPECT_EQ(selected.objects(), std::vector<int>{2});
    selected.hideObjects();
    EXPECT_EQ(selected.hidden(), (std::vector<bool>{false, false, true, false}));
    selected.set(selected.withObject(2, true), &plan, {});
    EXPECT_TRUE(selected.is(Selection::Kind::None));
}

}  // namespace
}  // namespace dollytrack::editor::selection_tracker_test
