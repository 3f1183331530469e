#include "app/editor/timeline/key_placement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dollytrack::editor::key_placement_test {
namespace {

MotionKey keyAt(double time_s, double x) {
    return {time_s, lookAt({x, 0.0, 1.0}, {x, 5.0, 1.0})};
}

/// Keys at 0, 2 and 4 s; the camera needs until 3 s for the second one.
struct Placing {
    Placing() {
        for (int i = 0; i <= 50; ++i) {
            TrajectoryFrame frame;
            frame.time_s = 0.1 * i;
            plan.trajectory.frames.push_back(frame);
        }
        plan.passed_keys = {{0, 0.0, ""}, {30, 3.0, "late"}, {50, 5.0, "late"}};
    }
    [[nodiscard]] KeyPlacement at(int playhead, int selected = -1) const {
        return placeKey(keys, &plan, playhead, selected, view, {});
    }
    std::vector<MotionKey> keys = {keyAt(0, 0), keyAt(2, 1), keyAt(4, 2)};
    Plan plan;
    Pose view = keyAt(0, 3).pose;
};

TEST(KeyPlacement, TheFirstKeyIsAtTheStart) {
    const KeyPlacement place = placeKey({}, nullptr, 40, -1, Pose{}, {});
    EXPECT_FALSE(place.replaces);
    EXPECT_EQ(place.time_s, 0.0);
}

TEST(KeyPlacement, TheSelectedKeyAndThatAtThePlayheadAreReplaced) {
    const Placing placing;
    EXPECT_EQ(placing.at(12, 2).replaces, 2U);
    EXPECT_EQ(placing.at(0).replaces, 0U);
    EXPECT_EQ(placing.at(30).replaces, 1U);
    EXPECT_EQ(placing.at(50, 2).replaces, 2U);
}

TEST(KeyPlacement, BetweenKeysItGetsTheTimeOfThePlayhead) {
    const Placing placing;
    // A third of the way to a key at 2 s, although the camera takes 3 s for it.
    const KeyPlacement place = placing.at(9);
    EXPECT_FALSE(place.replaces);
    EXPECT_NEAR(place.time_s, 0.6, 1e-9);
    EXPECT_NEAR(placing.at(40).time_s, 3.0, 1e-9);
}

TEST(KeyPlacement, AfterTheLastKeyItTakesTheTimeThatTheLimitsNeed) {
    Placing placing;
    // A metre at up to 0.5 m/s.
    const KeyPlacement place = placing.at(50);
    EXPECT_FALSE(place.replaces);
    EXPECT_GE(place.time_s, 6.0);
    EXPECT_LE(place.time_s, 8.5);
    EXPECT_NEAR(10.0 * place.time_s, std::round(10.0 * place.time_s), 1e-6);
    placing.view = keyAt(0, 12).pose;
    EXPECT_GE(placing.at(50).time_s, 24.0);
    // Twenty minutes away: estimated from the largest speed, at once.
    placing.view = keyAt(0, 602).pose;
    EXPECT_NEAR(placing.at(50).time_s, 4.0 + 1200.0, 1.0);
    placing.view = placing.keys.back().pose;
    EXPECT_NEAR(placing.at(50).time_s, 4.5, 1e-9) << "not on top of the last one";
}

TEST(KeyPlacement, WithoutAPlanOfTheseKeysItFollowsTheLast) {
    Placing placing;
    const KeyPlacement place = placeKey(placing.keys, nullptr, 0, -1, placing.view, {});
    EXPECT_FALSE(place.replaces);
    EXPECT_GT(place.time_s, 4.0);
    placing.plan.passed_keys.pop_back();
    EXPECT_GT(placing.at(0).time_s, 4.0);
}

}  // namespace
}  // namespace dollytrack::editor::key_placement_test
