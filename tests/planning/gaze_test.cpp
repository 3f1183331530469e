#include "engine/jobs/parallel.h"
#include "planning/gaze/image_motion.h"
#include "planning/gaze/panorama.h"
#include "planning/timing/turn.h"
#include "planning/visibility/pitch_band.h"
#include "tests/planning/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace dollytrack::planning {
namespace {

using test_support::planOf;

/// A hall with objects along both long walls.
Scene furnishedHall() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {9, 5, 2.6});
    for (int i = 0; i < 8; ++i) {
        const double x = 0.9 + i;
        builder.object("south " + std::to_string(i)).box({x, 0.3, 0.3}, {0.3, 0.3, 0.6});
        builder.object("north " + std::to_string(i)).box({x + 0.4, 4.7, 0.4}, {0.4, 0.3, 0.8});
    }
    return builder.build();
}

PlanParams withContext(double view_mix) {
    PlanParams params;
    params.gaze.view_mix = view_mix;
    return params;
}

double targetsAFrame(const Plan& plan) {
    double sum = 0.0;
    for (const auto& views : plan.frame_views) sum += static_cast<double>(views.size());
    return sum / static_cast<double>(plan.frame_views.size());
}

std::map<int, Pose> keyFramePoses(const Plan& plan) {
    std::map<int, Pose> poses;
    for (const TrajectoryFrame& frame : plan.trajectory.frames) {
        if (frame.position_point >= 0) poses[frame.position_point] = frame.pose;
    }
    return poses;
}

double largestTurn(const Trajectory& trajectory) {
    double largest = 0.0;
    for (std::size_t i = 1; i < trajectory.frames.size(); ++i) {
        largest = std::max(largest, angleBetween(trajectory.frames[i - 1].pose.rotation,
                                                 trajectory.frames[i].pose.rotation));
    }
    return largest;
}

}  // namespace

TEST(ContextViews, ShowMoreObjectsAFrameAndLeaveKeyFramesAsTheyAre) {
    const Scene scene = furnishedHall();
    const auto close = planOf(scene, withContext(0.0));
    const auto mixed = planOf(scene, withContext(0.7));
    EXPECT_GT(targetsAFrame(*mixed), 1.2 * targetsAFrame(*close));
    EXPECT_EQ(keyFramePoses(*mixed), keyFramePoses(*close));
    EXPECT_EQ(mixed->capture_metrics.well_captured_rate, close->capture_metrics.well_captured_rate);
    EXPECT_EQ(mixed->trajectory_metrics.frame_collision_rate, 0.0);
    EXPECT_DOUBLE_EQ(mixed->smooth_paths.front().length_m, close->smooth_paths.front().length_m);
}

TEST(ContextViews, AreTheSameForAnyNumberOfThreads) {
    const Scene scene = furnishedHall();
    setThreadCount(1);
    const auto one = planOf(scene, withContext(0.7));
    setThreadCount(0);
    const auto many = planOf(scene, withContext(0.7));
    ASSERT_EQ(one->trajectory.frames.size(), many->trajectory.frames.size());
    for (std::size_t i = 0; i < one->trajectory.frames.size(); ++i) {
        EXPECT_EQ(one->trajectory.frames[i].pose, many->trajectory.frames[i].pose) << i;
    }
}

TEST(ContextViews, KeepToBudgetAndPitchBand) {
    PlanParams params = withContext(1.0);
    params.timing.max_frames = 60;
    params.constraints.min_pitch_deg = -20.0;
    params.constraints.max_pitch_deg = 10.0;
    const auto plan = planOf(furnishedHall(), params);
    EXPECT_LE(plan->trajectory.frames.size(), 60U);
    EXPECT_TRUE(std::ranges::any_of(plan->smooth_paths.front().keys,
                                    [](const auto& key) { return key.position_point < 0; }));
    const PitchBand band = pitchBand(params.constraints);
    for (const TrajectoryFrame& frame : plan->trajectory.frames) {
        EXPECT_TRUE(band.holds(frame.pose.rotation));
    }
}

TEST(ContextViews, AreNoneForACameraThatLooksAlongItsMotion) {
    PlanParams params;
    params.body.camera_preset = CameraPreset::Robot;
    applyCameraPreset(params);
    const auto without = planOf(furnishedHall(), params);
    params.gaze.view_mix = 0.7;
    const auto with = planOf(furnishedHall(), params);
    ASSERT_EQ(with->trajectory.frames.size(), without->trajectory.frames.size());
    for (std::size_t i = 0; i < with->trajectory.frames.size(); ++i) {
        EXPECT_EQ(with->trajectory.frames[i].pose, without->trajectory.frames[i].pose);
    }
}

TEST(Panorama, ShowsWhatIsInTheImageAndNotHidden) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 6, 3});
    builder.object("in sight").box({4, 3, 1}, {0.5, 0.5, 0.5});
    builder.object("screen").box({3, 5, 1}, {2, 0.1, 2});
    builder.object("hidden").box({3, 5.6, 1}, {0.3, 0.3, 0.3});
    const Scene scene = builder.build();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, CameraParams{});
    const TargetSamples samples(views);
    const Panorama panorama(views, samples, {2, 3, 1});
    const auto shown = [&](const Eigen::Vector3d& direction) {
        std::map<std::string, double> by_name;
        panorama.visitShown(direction, [&](std::size_t target, double share) {
            by_name[scene.object(samples.targets()[target].object_id).name] = share;
        });
        return by_name;
    };
    EXPECT_TRUE(shown({1, 0, 0}).contains("in sight"));
    EXPECT_FALSE(shown({-1, 0, 0}).contains("in sight"));
    EXPECT_FALSE(shown({1, 2.6, 0}).contains("hidden"));
    EXPECT_TRUE(shown({1, 2, 0}).contains("screen"));
}

TEST(ImageMotion, IsTheTurnPlusTheWayOverTheDistance) {
    const Scene scene = test::SceneBuilder().room({0, 0, 0}, {8, 4, 3}).build();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, CameraParams{});
    SmoothPath path;
    path.append({2, 1, 1.5}, {3, 1, 1.5}, {4, 1, 1.5}, false);
    path.keys = {{0.0, -1, {2, 1, 1.5}, {2, 4, 1.5}, 0.0},
                 {2.0, -1, {4, 1, 1.5}, {4, 4, 1.5}, 0.0}};
    const auto pose_at = [](const SmoothPath::Key& key) {
        return lookAt(key.position, key.looks_at);
    };
    measureImageMotion(path, pose_at, views, PitchBand{});
    EXPECT_NEAR(path.keys[1].image_motion_rad, 2.0 / 3.0, 1e-6);  // 2 m past a wall 3 m away
    path.keys[1].looks_at = {8, 1, 1.5};
    path.keys[1].arc_m = 0.0;
    path.keys[1].position = {2, 1, 1.5};
    measureImageMotion(path, pose_at, views, PitchBand{});
    EXPECT_NEAR(path.keys[1].image_motion_rad, 0.5 * 3.14159265, 1e-3);  // on the spot
}

TEST(ImageMotion, IsSpreadMoreEvenlyOverABudgetOfFrames) {
    PlanParams params;
    params.timing.max_frames = 120;
    params.timing.max_repeat_rate = 1.0;
    const auto fast = planOf(furnishedHall(), params);
    params.timing.max_image_motion_dps = 15.0;
    const auto even = planOf(furnishedHall(), params);
    EXPECT_LE(even->trajectory.frames.size(), 120U);
    EXPECT_LT(largestTurn(even->trajectory), largestTurn(fast->trajectory));
    EXPECT_EQ(keyFramePoses(*even), keyFramePoses(*fast));
}

}  // namespace dollytrack::planning
