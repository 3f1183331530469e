#include "ui/viewport/adaptive_resolution.h"

#include <gtest/gtest.h>

namespace dollytrack::ui::adaptive_resolution_test {
namespace {

using std::chrono::milliseconds;

// A mouse drag over a scene whose full image takes 120 ms.
TEST(AdaptiveResolution, IsCoarseWhileTheViewMovesAndWholeWhenItRests) {
    AdaptiveResolution resolution;
    AdaptiveResolution::Time now{std::chrono::hours(1)};
    EXPECT_EQ(resolution.shrinkFor(false, now), 1);  // the time is not known yet
    resolution.drew(1, false, true, 120.0, now);
    EXPECT_EQ(resolution.shrinkFor(false, now + milliseconds(20)), 2);
    resolution.drew(2, false, true, 40.0, now += milliseconds(60));
    EXPECT_EQ(resolution.shrinkFor(false, now + milliseconds(20)), 2);
    EXPECT_EQ(resolution.restsAt(), now + AdaptiveResolution::kRest);
    EXPECT_EQ(resolution.shrinkFor(true, resolution.restsAt()), 1);
    // A single step does not count as movement.
    EXPECT_EQ(resolution.shrinkFor(false, now + milliseconds(500)), 1);
}

TEST(AdaptiveResolution, SlowScenesRestLater) {
    AdaptiveResolution resolution;
    const AdaptiveResolution::Time now{std::chrono::hours(1)};
    resolution.drew(1, false, true, 400.0, now);
    EXPECT_EQ(resolution.restsAt(), now + milliseconds(400));
    resolution.drew(1, false, true, 9000.0, now);
    EXPECT_LT(resolution.restsAt(), now + milliseconds(1000));
    resolution.drew(1, false, true, 10.0, now);
    EXPECT_EQ(resolution.restsAt(), now + AdaptiveResolution::kRest);
}

TEST(AdaptiveResolution, NewLayersOverTheSameViewNeitherMoveItNorTellWhatItTakes) {
    AdaptiveResolution resolution;
    AdaptiveResolution::Time now{std::chrono::hours(1)};
    resolution.drew(1, false, true, 120.0, now);
    resolution.drew(2, false, true, 40.0, now += milliseconds(60));
    const AdaptiveResolution::Time rests = resolution.restsAt();
    for (int i = 0; i < 10; ++i) {
        now += milliseconds(30);
        const int shrink = resolution.shrinkFor(true, now);
        EXPECT_EQ(shrink, now < rests ? 2 : 1) << i;
        resolution.drew(shrink, true, shrink == 1 && i == 4, 130.0, now);
        if (i != 4) resolution.drew(shrink, true, false, 2.0, now);
    }
    EXPECT_EQ(resolution.restsAt(), rests);
    resolution.drew(1, false, false, 2.0, now);
    EXPECT_EQ(resolution.shrinkFor(false, now + milliseconds(20)), 2);
}

TEST(AdaptiveResolution, LeavesFastScenesWholeAndShrinksSlowOnesMore) {
    AdaptiveResolution resolution;
    const AdaptiveResolution::Time now{std::chrono::hours(1)};
    resolution.drew(1, false, true, AdaptiveResolution::kFluent_ms, now);
    EXPECT_EQ(resolution.shrinkFor(false, now), 1);
    resolution.drew(1, false, true, 900.0, now);
    EXPECT_EQ(resolution.shrinkFor(false, now), 3);
    resolution.forget();
    EXPECT_EQ(resolution.shrinkFor(false, now), 1);
}

}  // namespace
}  // namespace dollytrack::ui::adaptive_resolution_test
