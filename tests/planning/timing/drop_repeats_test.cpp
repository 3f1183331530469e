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

// A room with few objects is soon seen completely: many frames would show nothing new.
TEST(DropRepeats, LowersTheRateUntilFewFramesRepeatAndLosesNoCapture) {
    PlanParams params;
    params.gaze.view_mix = 0.0;  // room views repeat, and all of them stay
    params.timing.max_frames = 300;
    params.timing.frame_rate = 30.0;
    const auto all = planned(params, 1.0);
    ASSERT_TRUE(all);
    ASSERT_GT(all->trajectory_metrics.repeat_rate, 0.1);
    const double limit = 0.5 * all->trajectory_metrics.repeat_rate;
    const auto thinned = planned(params, limit);
    ASSERT_TRUE(thinned);
    EXPECT_LE(thinned->trajectory_metrics.repeat_rate, limit);
    EXPECT_LT(thinned->trajectory.frames.size(), all->trajectory.frames.size());
    EXPECT_GT(thinned->trajectory.frames.size(), thinned->key_frames.size());
    EXPECT_EQ(keysInOrder(thinned->trajectory), keysInOrder(all->trajectory));
    EXPECT_EQ(thinned->capture_metrics.captured, all->capture_metrics.captured);
    EXPECT_EQ(thinned->capture_metrics.well_captured, all->capture_metrics.well_captured);
    for (std::size_t i = 0; i < thinned->trajectory.frames.size(); ++i) {
        EXPECT_DOUBLE_EQ(thinned->trajectory.frames[i].time_s,
                         static_cast<double>(i) * thinned->trajectory.frame_interval_s);
    }
}

// No more frames are dropped than necessary: with half as many again, too many would repeat.
TEST(DropRepeats, KeepsAsManyFramesAsTheLimitAllows) {
    PlanParams params;
    params.gaze.view_mix = 0.0;  // room views are key frames, which stay
    params.timing.max_frames = 300;
    params.timing.frame_rate = 30.0;
    const double all = planned(params, 1.0)->trajectory_metrics.repeat_rate;
    for (const double share : {0.3, 0.4, 0.5, 0.6, 0.7}) {
        params.timing.max_frames = 300;
        const double limit = share * all;
        const auto thinned = planned(params, limit);
        const auto frames = static_cast<int>(thinned->trajectory.frames.size());
        EXPECT_LT(thinned->trajectory_metrics.repeat_rate, limit);
        params.timing.max_frames = frames + frames / 2;
        EXPECT_GT(planned(params, 1.0)->trajectory_metrics.repeat_rate, limit) << frames;
    }
}

// Some key frames repeat, and all of them stay, so that no frame rate meets a limit of 0.
TEST(DropRepeats, ALimitThatNoFrameRateMeetsDropsNothing) {
    PlanParams params;
    params.timing.max_frames = 300;
    const auto all = planned(params, 1.0);
    const auto limited = planned(params, 0.0);
    ASSERT_TRUE(all && limited);
    EXPECT_GT(limited->trajectory_metrics.repeat_rate, 0.0);
    EXPECT_EQ(limited->trajectory.frames.size(), all->trajectory.frames.size());
    EXPECT_DOUBLE_EQ(limited->trajectory.frame_interval_s, all->trajectory.frame_interval_s);
}

TEST(FrameRate, WhatLoweredItIsKnown) {
    TimingParams params;  // 10 frames per second
    const auto reason = [&](std::size_t frames, double interval_s) {
        Trajectory trajectory{interval_s, {}};
        trajectory.frames.resize(frames);
        return whatLoweredTheFrameRate(trajectory, params);
    };
    EXPECT_EQ(reason(30, 0.2), "") << "as read from a file";
    params.max_frames = 300;
    EXPECT_EQ(reason(300, 0.1), "");
    EXPECT_EQ(reason(298, 0.2), "max_frames");
    EXPECT_EQ(reason(200, 0.2), "max_repeat_rate");
    params.max_frames = 10;
    EXPECT_EQ(reason(9, 0.2), "max_frames");
    params.keep_frame_rate = true;
    EXPECT_EQ(reason(5, 0.2), "");
}

// Without a budget the frame rate stays as requested.
TEST(DropRepeats, WithoutABudgetNothingIsDropped) {
    const PlanParams params;
    const auto plan = planned(params, 0.2);
    ASSERT_TRUE(plan);
    EXPECT_DOUBLE_EQ(plan->trajectory.frame_interval_s, 1.0 / params.timing.frame_rate);
}

}  // namespace dollytrack::planning::drop_repeats_test
