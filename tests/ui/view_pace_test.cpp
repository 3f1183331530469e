#include "ui/viewport/view_pace.h"

#include <gtest/gtest.h>

namespace dollytrack::ui {
namespace {

using std::chrono::milliseconds;

// A mouse drag over a scene whose full image takes 120 ms.
TEST(ViewPace, IsCoarseWhileTheViewMovesAndWholeWhenItRests) {
    ViewPace pace;
    ViewPace::Time now{std::chrono::hours(1)};
    EXPECT_EQ(pace.shrinkFor(false, now), 1);  // the time is not known yet
    pace.drew(1, false, true, 120.0, now);
    EXPECT_EQ(pace.shrinkFor(false, now + milliseconds(20)), 2);
    pace.drew(2, false, true, 40.0, now += milliseconds(60));
    EXPECT_EQ(pace.shrinkFor(false, now + milliseconds(20)), 2);
    EXPECT_EQ(pace.restsAt(), now + ViewPace::kRest);
    EXPECT_EQ(pace.shrinkFor(true, pace.restsAt()), 1);
    // A single step does not count as movement.
    EXPECT_EQ(pace.shrinkFor(false, now + milliseconds(500)), 1);
}

TEST(ViewPace, NewLayersOverTheSameViewNeitherMoveItNorTellWhatItTakes) {
    ViewPace pace;
    ViewPace::Time now{std::chrono::hours(1)};
    pace.drew(1, false, true, 120.0, now);
    pace.drew(2, false, true, 40.0, now += milliseconds(60));
    const ViewPace::Time rests = pace.restsAt();
    for (int i = 0; i < 10; ++i) {
        now += milliseconds(30);
        const int shrink = pace.shrinkFor(true, now);
        EXPECT_EQ(shrink, now < rests ? 2 : 1) << i;
        pace.drew(shrink, true, shrink == 1 && i == 4, 130.0, now);
        if (i != 4) pace.drew(shrink, true, false, 2.0, now);
    }
    EXPECT_EQ(pace.restsAt(), rests);
    pace.drew(1, false, false, 2.0, now);
    EXPECT_EQ(pace.shrinkFor(false, now + milliseconds(20)), 2);
}

TEST(ViewPace, LeavesFastScenesWholeAndShrinksSlowOnesMore) {
    ViewPace pace;
    const ViewPace::Time now{std::chrono::hours(1)};
    pace.drew(1, false, true, ViewPace::kFluent_ms, now);
    EXPECT_EQ(pace.shrinkFor(false, now), 1);
    pace.drew(1, false, true, 900.0, now);
    EXPECT_EQ(pace.shrinkFor(false, now), 3);
    pace.forget();
    EXPECT_EQ(pace.shrinkFor(false, now), 1);
}

}  // namespace
}  // namespace dollytrack::ui
