#include "engine/plan/capture.h"

#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace dollytrack::capture_test {

TEST(Capture, CountsTargetsOnlyAndSeparatesWellFromBarely) {
    const Scene scene = test::furnishedRoom();  // six structure objects, then five targets
    const int table = 7;
    const int mug = 8;
    const int book = 9;
    const std::vector<ObjectView> views = {
        {table, 0, 0.90, 60000, 0.30, 0.20}, {table, 1, 0.79, 90000, 0.60, 0.50},
        {mug, 0, 0.95, 400, 0.002, 0.001},   {mug, 2, 0.85, 20000, 0.08, 0.06},
        {book, 0, 0.99, 119, 0.06, 0.04},    {1, 0, 1.0, 200000, 0.9, 0.8},
    };
    const auto captures = bestCaptures(scene, views);
    ASSERT_EQ(captures.size(), 5U);
    EXPECT_EQ(captures[0].best.frame, 0);
    EXPECT_TRUE(captures[0].well_captured);
    EXPECT_EQ(captures[1].best.frame, 0);       // the highest visible fraction
    EXPECT_EQ(captures[1].best_well.frame, 2);  // the only well captured view
    EXPECT_FALSE(captures[2].captured);         // 119 px
    EXPECT_EQ(captures[3].best.frame, -1);

    const CaptureMetrics metrics = summarize(scene, captures);
    EXPECT_EQ(metrics.objects, 5);
    EXPECT_DOUBLE_EQ(metrics.capture_rate, 0.4);
    EXPECT_DOUBLE_EQ(metrics.well_captured_rate, 0.4);
    EXPECT_DOUBLE_EQ(metrics.area_share_box, (0.30 + 0.002) / 2);
}

}  // namespace dollytrack::capture_test
