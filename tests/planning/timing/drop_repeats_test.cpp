#include "planning/timing/drop_repeats.h"

#include "planning/pipeline/pipeline.h"
#include "planning/timing/clip.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dollytrack::planning::drop_repeats_test {
namespace {

std::shared_ptr<const Plan> planned(PlanParams params, double max_repeat_rate) {
    params.timing.max_repeat_rate = max_repeat_rate;
    Pipeline pipeline(std::make_shared<const Scene>(test::furnishedRoom()));
    const auto plan = pipeline.run(params, JobContext{});
    EXPECT_TRUE(plan.has_value());
    return plan ? *plan : nullptr;
}

std::vector<int> keysInOrder(const Trajectory& trajectory) {
    std::vector<int> keys;
    for (const TrajectoryFrame& frame : trajectory.frames) {
        if (frame.position_point >= 0) keys.push_back(frame.position_point);
    }
    return keys;
}

}  // namespace

// A room with few objects is soon seen completely: many frames show nothing new.
TEST(DropRepeats, LeavesOutFramesThatShowNothingNewAndNoMore) {
    PlanParams params;
    params.timing.max_frames = 300;
    const auto all = planned(params, 1.0);
    ASSERT_TRUE(all);
    const double limit = 0.8 * all->trajectory_metrics.repeat_rate;
    ASSERT_GT(limit, 0.1);
    const auto thinned = planned(params, limit);
    ASSERT_TRUE(thinned);
    EXPECT_LE(thinned->trajectory_metrics.repeat_rate, limit);
    // No more frames are left out than necessary.
    EXPECT_GT(thinned->trajectory_metrics.repeat_rate, 0.9 * limit);
    EXPECT_EQ(keysInOrder(thinned->trajectory), keysInOrder(all->trajectory));
    EXPECT_EQ(thinned->capture_metrics.captured, all->capture_metrics.captured);
    EXPECT_EQ(thinned->capture_metrics.well_captured, all->capture_metrics.well_captured);
    EXPECT_EQ(thinned->trajectory.frames.back().time_s, all->trajectory.frames.back().time_s);
}

// Some key frames repeat, and all of them stay.
TEST(DropRepeats, ALimitThatKeyFramesExceedLeavesOutNothing) {
    PlanParams params;
    params.timing.max_frames = 300;
    const auto all = planned(params, 1.0);
    const auto limited = planned(params, 0.0);
    ASSERT_TRUE(all && limited);
    EXPECT_GT(limited->trajectory_metrics.repeat_rate, 0.0);
    EXPECT_EQ(limited->trajectory.frames.size(), all->trajectory.frames.size());
}

TEST(LeftOutFrames, TheReasonIsKnown) {
    TimingParams params;
    const auto reason = [&](std::size_t frames, std::size_t left_out) {
        Trajectory trajectory;
        trajectory.frames.resize(frames);
        trajectory.left_out.resize(left_out);
        return whyFramesWereLeftOut(trajectory, params);
    };
    EXPECT_EQ(reason(30, 5), "") << "low frames";
    params.max_frames = 300;
    EXPECT_EQ(reason(300, 0), "");
    EXPECT_EQ(reason(300, 5), "max_frames");
    params.max_repeat_rate = 0.5;
    EXPECT_EQ(reason(300, 5), "max_frames");
    EXPECT_EQ(reason(200, 5), "max_repeat_rate");
    params.keep_frame_rate = true;
    EXPECT_EQ(reason(200, 5), "");
}

// Without a budget the frame rate stays as requested.
TEST(DropRepeats, WithoutABudgetNothingIsDropped) {
    const PlanParams params;
    const auto plan = planned(params, 0.2);
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->trajectory.frames.size(), planned(params, 1.0)->trajectory.frames.size());
}

}  // namespace dollytrack::planning::drop_repeats_test
