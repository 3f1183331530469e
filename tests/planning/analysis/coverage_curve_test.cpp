#include "planning/analysis/coverage_curve.h"

#include "planning/pipeline/pipeline.h"
#include "tests/planning/support/rising_progress.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace dollytrack::planning::coverage_curve_test {

// Each point of the curve equals the result of a plan made from scratch with that budget.
TEST(CoverageCurve, EachPointIsThePlanOfItsBudget) {
    const auto scene = std::make_shared<const Scene>(test::furnishedRoom());
    PlanParams params;
    params.timing.max_frames = 40;
    Pipeline pipeline(scene);
    const auto plan = pipeline.run(params, JobContext{});
    ASSERT_TRUE(plan);
    test_support::RisingProgress progress;
    const auto curves = coverageCurves(pipeline, params, {}, **plan, progress.job());
    ASSERT_TRUE(curves);
    EXPECT_GT(progress.reports(), 3);
    ASSERT_GT(curves->by_frames.size(), 3U);
    ASSERT_GT(curves->by_length.size(), 3U);
    EXPECT_EQ(curves->by_frames.front().max_frames, 1);
    EXPECT_EQ(curves->by_frames.back().max_frames, 40);
    int before = 0;
    for (const auto* points : {&curves->by_frames, &curves->by_length}) {
        for (const CoveragePoint& point : *points) {
            PlanParams alone = params;
            alone.timing.max_frames = point.max_frames;
            alone.path.max_length_m = point.max_length_m;
            const auto made = Pipeline(scene).run(alone, JobContext{});
            ASSERT_TRUE(made);
            EXPECT_EQ(point.frames, static_cast<int>((*made)->trajectory.frames.size()));
            EXPECT_EQ(point.path_length_m, (*made)->trajectory_metrics.path_length_m);
            EXPECT_EQ(point.captured, (*made)->capture_metrics.captured);
            EXPECT_EQ(point.well_captured, (*made)->capture_metrics.well_captured);
            EXPECT_LE(point.frames, point.max_frames);
        }
    }
    for (const CoveragePoint& point : curves->by_frames) {
        EXPECT_GE(point.well_captured, before);  // key frames are ordered by how much they add
        before = point.well_captured;
    }
    EXPECT_EQ(before, (*plan)->capture_metrics.well_captured);
    EXPECT_EQ(curves->by_length.back().path_length_m, (*plan)->trajectory_metrics.path_length_m);
}

}  // namespace dollytrack::planning::coverage_curve_test
