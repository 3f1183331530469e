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
    [[nodiscard]] double at(int playhead, int after = -1) const {
        return timeOfNewKey(keys, &plan, playhead, after, view, {});
    }
    std::vector<MotionKey> keys = {keyAt(0, 0), keyAt(2, 1), keyAt(4, 2)};
    Plan plan;
    Pose view = keyAt(0, 3).pose;
};

TEST(KeyPlacement, TheFirstKeyIsAtTheStart) {
    EXPECT_EQ(timeOfNewKey({}, nullptr, 40, -1, Pose{}, {}), 0.0);
}

TEST(KeyPlacement, ItFollowsTheSelectedKeyOrTheOneAtThePlayhead) {
    const Placing placing;
    EXPECT_NEAR(placing.at(50, 0), 1.0, 1e-9);
    EXPECT_NEAR(placing.at(0, 1), 3.0, 1e-9);
    EXPECT_NEAR(placing.at(0), 1.0, 1e-9);
    EXPECT_NEAR(placing.at(30), 3.0, 1e-9);
    EXPECT_GT(placing.at(12, 2), 4.0);
    // With the playhead behind the selected key, at its time.
    EXPECT_NEAR(placing.at(9, 0), 0.6, 1e-9);
}

TEST(KeyPlacement, BetweenNearTimesItIsHalfwayWithoutAFrameOfItsOwn) {
    Placing placing;
    placing.keys[1].time_s = 0.1;
    EXPECT_NEAR(placing.at(50, 0), 0.05, 1e-9);
}

TEST(KeyPlacement, BetweenKeysItGetsTheTimeOfThePlayhead) {
    const Placing placing;
    // A third of the way to a key at 2 s, although the camera takes 3 s for it.
    EXPECT_NEAR(placing.at(9), 0.6, 1e-9);
    EXPECT_NEAR(placing.at(40), 3.0, 1e-9);
}

TEST(KeyPlacement, TheKeyAtThePlayheadIsFound) {
    const Placing placing;
    EXPECT_EQ(keyAtPlayhead(placing.keys, &placing.plan, 30), 1U);
    EXPECT_FALSE(keyAtPlayhead(placing.keys, &placing.plan, 29));
    EXPECT_FALSE(keyAtPlayhead(placing.keys, nullptr, 30));
}

TEST(KeyPlacement, AfterTheLastKeyItTakesTheTimeThatTheLimitsNeed) {
    Placing placing;
    // A metre at up to 0.5 m/s.
    const double time_s = placing.at(50);
    EXPECT_GE(time_s, 6.0);
    EXPECT_LE(time_s, 8.5);
    EXPECT_NEAR(10.0 * time_s, std::round(10.0 * time_s), 1e-6);
    placing.view = keyAt(0, 12).pose;
    EXPECT_GE(placing.at(50), 24.0);
    // Twenty minutes away: estimated from the largest speed, at once.
    placing.view = keyAt(0, 602).pose;
    EXPECT_NEAR(placing.at(50), 4.0 + 1200.0, 1.0);
    placing.view = placing.keys.back().pose;
    EXPECT_NEAR(placing.at(50), 4.5, 1e-9) << "not on top of the last one";
}

TEST(KeyPlacement, WithoutAPlanOfTheseKeysItFollowsTheLast) {
    Placing placing;
    EXPECT_GT(timeOfNewKey(placing.keys, nullptr, 0, -1, placing.view, {}), 4.0);
    placing.plan.passed_keys.pop_back();
    EXPECT_GT(placing.at(0), 4.0);
}

}  // namespace
}  // namespace dollytrack::editor::key_placement_test
