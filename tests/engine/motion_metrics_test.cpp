#include "engine/plan/motion_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dollytrack::motion_metrics_test {
namespace {

Trajectory along(double (*way)(double), int count) {
    Trajectory trajectory;
    trajectory.frame_interval_s = 0.1;
    for (int i = 0; i < count; ++i) {
        TrajectoryFrame frame;
        frame.time_s = 0.1 * i;
        frame.pose.position.x() = way(frame.time_s);
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

}  // namespace

// x = t^3: central differences of a cubic are exact, and the third difference is constant.
TEST(MotionMetrics, AreTheDifferencesOfThePoses) {
    const MotionMetrics motion = measureMotion(along([](double t) { return t * t * t; }, 12));
    EXPECT_NEAR(motion.speed_mps.max, (1.331 - 1.0) / 0.1, 1e-9);
    EXPECT_NEAR(motion.acceleration_mps2.max, 6.0, 1e-9);  // at 1 s
    EXPECT_NEAR(motion.jerk_mps3.median, 6.0, 1e-6);
    EXPECT_NEAR(motion.jerk_mps3.max, 6.0, 1e-6);
    // Accelerations 0.6, 1.2 ... 6: ten values, evenly spaced.
    EXPECT_NEAR(motion.acceleration_mps2.median, 3.3, 1e-9);
    EXPECT_NEAR(motion.acceleration_mps2.p95, 0.6 + 0.95 * 5.4, 1e-9);
    EXPECT_EQ(motion.turn_dps.max, 0.0);
}

// x = t^2: divided differences at midpoints are exact for any steps.
TEST(MotionMetrics, MayHaveUnevenSteps) {
    Trajectory trajectory;
    for (const double t : {0.0, 0.1, 0.4, 0.5, 1.1}) {
        TrajectoryFrame frame;
        frame.time_s = t;
        frame.pose.position.x() = t * t;
        trajectory.frames.push_back(frame);
    }
    const MotionMetrics motion = measureMotion(trajectory);
    EXPECT_NEAR(motion.speed_mps.max, 1.6, 1e-9);
    EXPECT_NEAR(motion.acceleration_mps2.max, 2.0, 1e-9);
    EXPECT_NEAR(motion.acceleration_mps2.median, 2.0, 1e-9);
    EXPECT_NEAR(motion.jerk_mps3.max, 0.0, 1e-9);
}

TEST(MotionMetrics, MeasureTurningAndItsChange) {
    Trajectory trajectory = along([](double) { return 0.0; }, 11);
    for (TrajectoryFrame& frame : trajectory.frames) {
        const double t = frame.time_s;
        frame.pose.rotation =
            Eigen::AngleAxisd(20.0 * t * t * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ());
    }
    const MotionMetrics motion = measureMotion(trajectory);
    EXPECT_NEAR(motion.turn_dps.max, 40.0 * 0.95, 1e-6);
    EXPECT_NEAR(motion.turn_acceleration_dps2.median, 40.0, 1e-6);
}

TEST(MotionMetrics, SeeNoMotionWhereTheCameraIsCarriedOver) {
    Trajectory trajectory = along([](double t) { return 0.5 * t; }, 10);
    for (std::size_t i = 5; i < 10; ++i) {
        trajectory.frames[i].path = 1;
        trajectory.frames[i].pose.position.x() += 100.0;
    }
    EXPECT_NEAR(measureMotion(trajectory).speed_mps.max, 0.5, 1e-9);
    EXPECT_NEAR(measureMotion(trajectory).acceleration_mps2.max, 0.0, 1e-6);
    EXPECT_EQ(measureMotion({}).speed_mps.max, 0.0);
}

}  // namespace dollytrack::motion_metrics_test
