#include "app/editor/playback.h"

#include "app/editor/selected.h"
#include "app/editor/step_playback.h"

#include <gtest/gtest.h>

namespace dollytrack::editor {
namespace {

using ui::Selection;

TEST(Playback, LosesNoTimeBetweenFramesAndStopsAtTheEnd) {
    Playback playback;
    playback.setFrameCount(5);
    playback.toggle();
    for (int i = 0; i < 8; ++i) playback.advance(0.25, false);  // exact in binary
    EXPECT_EQ(playback.frame(), 2);
    playback.advance(10.0, false);
    EXPECT_EQ(playback.frame(), 4);
    EXPECT_FALSE(playback.playing());
    playback.toggle();  // at the end: from the beginning
    EXPECT_EQ(playback.frame(), 0);
    playback.advance(7.0, true);
    EXPECT_EQ(playback.frame(), 2);
    EXPECT_TRUE(playback.playing());
    playback.setFrameCount(2);
    EXPECT_EQ(playback.frame(), 1);
}

TEST(StepPlayback, GoesFromStopToStop) {
    const StepPlayback::Next next = [](std::size_t taken) -> std::optional<std::size_t> {
        if (taken >= 7) return std::nullopt;
        return taken + 3;
    };
    StepPlayback steps;
    steps.toggle(next);
    steps.advance(2.5, next);
    EXPECT_EQ(steps.taken(), 6U);
    steps.advance(5.0, next);
    EXPECT_EQ(steps.taken(), 9U);
    EXPECT_FALSE(steps.playing());
    steps.toggle(next);
    EXPECT_EQ(steps.taken(), 0U);
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

TEST(Selected, FindsAPointAgainByWhatItLooksAt) {
    const Plan before = planOf({{1}, {2, 3}, {4}});
    const Plan after = planOf({{5}, {4}, {1}, {2, 3}});
    Selected selected;
    selected.set(Selection::ofItem(Selection::Kind::PositionPoint, 1), &before);
    EXPECT_TRUE(selected.keepIn(&after));
    EXPECT_EQ(selected.now().index, 3);
    EXPECT_EQ(selected.positionPoint(&after), &after.position_points[3]);
    const Plan without = planOf({{5}, {2}});
    EXPECT_FALSE(selected.keepIn(&without));
    EXPECT_TRUE(selected.is(Selection::Kind::None));
}

TEST(Selected, ForgetsEdgesAndKeepsObjectsInANewPlan) {
    const Plan plan = planOf({{1}});
    Selected selected;
    selected.set(Selection::ofItem(Selection::Kind::Edge, 0), &plan);
    EXPECT_FALSE(selected.keepIn(&plan));
    selected.set(selected.withObject(4, false), &plan);
    selected.set(selected.withObject(2, true), &plan);
    EXPECT_TRUE(selected.is(Selection::Kind::Objects));
    EXPECT_TRUE(selected.keepIn(nullptr));
    EXPECT_EQ(selected.objects(), (std::vector<int>{4, 2}));
    Scene scene;
    scene.objects.resize(3);
    selected.keepIn(scene);
    EXPECT_EQ(selected.objects(), std::vector<int>{2});
    selected.hideObjects();
    EXPECT_EQ(selected.hidden(), (std::vector<bool>{false, false, true, false}));
    selected.set(selected.withObject(2, true), &plan);
    EXPECT_TRUE(selected.is(Selection::Kind::None));
}

}  // namespace
}  // namespace dollytrack::editor
