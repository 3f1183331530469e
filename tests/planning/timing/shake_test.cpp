#include "planning/timing/shake.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "engine/plan/plan_json.h"
#include "planning/visibility/view_estimator.h"
#include "tests/planning/support/plan_support.h"
#include "tests/planning/support/slow_checker.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace dollytrack::planning::shake_test {
namespace {

using test_support::planOf;

PlanParams shakenBy(ShakeKind kind, double amplitude_m) {
    PlanParams params;
    params.shake.shake = kind;
    params.shake.shake_amplitude_m = amplitude_m;
    return params;
}

double furthest(const Trajectory& a, const Trajectory& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.frames.size(); ++i) {
        most = std::max(most, (a.frames[i].pose.position - b.frames[i].pose.position).norm());
    }
    return most;
}

}  // namespace

// A shake of 30 cm in a door of 80 cm and between furniture must be reduced, all along the
// camera's path and not only at its frames.
TEST(Shake, TouchesNothing) {
    for (const Scene& scene : {test::twoRoomsWithDoor(0.8), test::furnishedRoom()}) {
        const test_support::SlowChecker checker(scene);
        for (const ShakeKind kind : {ShakeKind::Sinusoidal, ShakeKind::Handheld}) {
            const auto steady = planOf(scene, PlanParams{});
            const PlanParams params = shakenBy(kind, 0.3);
            const auto plan = planOf(scene, params);
            const auto& frames = plan->trajectory.frames;
            ASSERT_EQ(frames.size(), steady->trajectory.frames.size());
            EXPECT_GT(furthest(plan->trajectory, steady->trajectory), 0.1);
            const double radius = params.camera.camera_radius_m;
            EXPECT_EQ(checker.check(*plan, radius, true).touching, 0);
            EXPECT_EQ(plan->trajectory_metrics.frame_collision_rate, 0.0);
            PlanParams few = params;
            few.timing.max_frames = 20;
            const auto sparse = planOf(scene, few);
            EXPECT_EQ(checker.check(*sparse, radius, true).touching, 0);
            EXPECT_GE(sparse->trajectory_metrics.minimum_clearance.clearance_m, radius - 1e-6);
        }
    }
}

// Without motion limits frames are metres apart, and the straight line from one to the next passes
// through objects that the camera flies around. The test measures the path it flies.
TEST(Shake, FewFramesOfAFastCameraHideNoCollision) {
    int lines_that_hit = 0;
    for (const Scene& scene : {test::twoRoomsWithDoor(0.8), test::furnishedRoom()}) {
        const test_support::SlowChecker checker(scene);
        for (const double frame_rate : {2.0, 10.0, 40.0}) {
            for (const int seed : {1, 2, 3}) {
                PlanParams params = shakenBy(ShakeKind::Sinusoidal, 0.03 * seed);
                params.timing.motion_preset = MotionPreset::Custom;
                params.timing.frame_rate = frame_rate;
                params.seed = seed;
                params.camera.camera_radius_m = 0.04;
                params.camera.near_m = 0.03;
                params.gaze.view_mix = 0.0;  // few frames, far apart
                const auto plan = planOf(scene, params);
                const double radius = params.camera.camera_radius_m;
                const auto found = checker.check(*plan, radius, true);
                EXPECT_EQ(found.touching, 0) << found.position.transpose();
                const TrajectoryMetrics& measured = plan->trajectory_metrics;
                EXPECT_GE(measured.minimum_clearance.clearance_m, radius);
                EXPECT_NEAR(measured.minimum_clearance.clearance_m, found.clearance_m, 1.2e-3);
                EXPECT_EQ(measured.frame_collision_rate, 0.0);
                lines_that_hit += measured.straight_lines_that_hit;
            }
        }
    }
    EXPECT_GT(lines_that_hit, 0);
}

TEST(Shake, CostsNoKeyFrameACapture) {
    const Scene scene = test::furnishedRoom();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, {});
    PlanParams params = shakenBy(ShakeKind::Handheld, 0.2);
    params.shake.shake_amplitude_deg = 12.0;
    const auto plan = planOf(scene, params);
    int keys = 0;
    for (const TrajectoryFrame& frame : plan->trajectory.frames) {
        if (frame.position_point < 0) continue;
        ++keys;
        const PositionPoint& point = plan->position_points[frame.position_point];
        for (const int id : point.captured) {
            EXPECT_TRUE(isCaptured(makeView(views.estimate(frame.pose, id, 72), id, 0))) << id;
        }
        for (const int id : point.well_captured) {
            EXPECT_TRUE(isWellCaptured(makeView(views.estimate(frame.pose, id, 72), id, 0))) << id;
        }
    }
    EXPECT_GT(keys, 1);
}

TEST(Shake, RepeatsBySeedWhateverTheThreads) {
    const Scene scene = test::furnishedRoom();
    const Trajectory steady = planOf(scene, PlanParams{})->trajectory;
    const auto text = [&](int threads) {
        setThreadCount(threads);
        const auto plan = planOf(scene, shakenBy(ShakeKind::Handheld, 0.05));
        setThreadCount(0);
        return trajectoryJson(plan->trajectory).dump();
    };
    EXPECT_EQ(text(1), text(4));
    const ShakeParams params = shakenBy(ShakeKind::Handheld, 0.05).shake;
    EXPECT_NE(CameraShake(params, 1).at(2.0), CameraShake(params, 2).at(2.0));
}

TEST(Shake, FramesThatWereLeftOutAreShakenTheSame) {
    const Scene scene = test::furnishedRoom();
    PlanParams params = shakenBy(ShakeKind::Handheld, 0.05);
    params.gaze.view_mix = 0.0;  // context views depend on the number of frames
    const Trajectory all = planOf(scene, params)->trajectory;
    params.timing.max_frames = static_cast<int>(all.frames.size()) / 3;
    const Trajectory fewer = planOf(scene, params)->trajectory;
    ASSERT_LT(fewer.frames.size(), all.frames.size() / 2);
    const std::vector<std::size_t> order = motionOrder(fewer);
    ASSERT_EQ(order.size(), all.frames.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(motionFrame(fewer, order[i]).pose, all.frames[i].pose) << i;
    }
}

TEST(Shake, SwaysWithinItsAmplitudeAtItsFrequency) {
    for (const ShakeKind kind : {ShakeKind::Sinusoidal, ShakeKind::Handheld}) {
        ShakeParams params;
        params.shake = kind;
        params.shake_hz = 2.0;
        const CameraShake camera_shake(params, 5);
        for (int channel = 0; channel < 6; ++channel) {
            int turns = 0;
            double most = 0.0;
            double last = camera_shake.at(0.0)[channel];
            constexpr int kSamples = 60'000;  // of 1 ms
            for (int i = 1; i <= kSamples; ++i) {
                const double now = camera_shake.at(i * 0.001)[channel];
                most = std::max(most, std::abs(now));
                turns += (now > 0.0) != (last > 0.0) ? 1 : 0;
                last = now;
            }
            EXPECT_LE(most, 1.0 + 1e-12);
            EXPECT_GT(most, 0.5);
            if (kind == ShakeKind::Sinusoidal) {  // two zero crossings per period
                EXPECT_GE(turns, 2 * 60 * 2.0 * 0.79);
                EXPECT_LE(turns, 2 * 60 * 2.0 * 1.26);
            }
        }
    }
}

TEST(Shake, BeginsAndEndsAtRestOnThePath) {
    const Scene scene = test::furnishedRoom();
    const auto steady = planOf(scene, PlanParams{});
    const auto plan = planOf(scene, shakenBy(ShakeKind::Sinusoidal, 0.05));
    EXPECT_EQ(plan->trajectory.frames.front().pose, steady->trajectory.frames.front().pose);
    EXPECT_EQ(plan->trajectory.frames.back().pose, steady->trajectory.frames.back().pose);
}

}  // namespace dollytrack::planning::shake_test
