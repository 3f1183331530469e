#include "planning/timing/time_trajectory.h"

#include "engine/plan/plan_json.h"
#include "planning/plan_params.h"
#include "planning/timing/motion_limits.h"
#include "planning/timing/turn.h"
#include "tests/planning/timing/tour_support.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning::time_trajectory_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using test_support::Tour;

constexpr double kRadians = std::numbers::pi / 180.0;

Quaterniond looking(double yaw_deg, double pitch_deg) {
    const double yaw = yaw_deg * kRadians;
    const double pitch = pitch_deg * kRadians;
    return lookAlong(
        {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)});
}

/// Camera x stays level and camera y points down: no roll.
void expectRollFree(const Quaterniond& rotation) {
    EXPECT_NEAR((rotation * Vector3d::UnitX()).z(), 0.0, 1e-6);
    EXPECT_LE((rotation * Vector3d::UnitY()).z(), 1e-6);
}

double angle(const Quaterniond& a, const Quaterniond& b) {
    return 2.0 * std::acos(std::min(1.0, std::abs(a.dot(b))));
}

Tour threeKeysAndTwo() {
    Tour tour;
    tour.startPath();
    tour.key({0, 0, 1}, {1, 0, 0.5});
    tour.key({2, 0, 1}, {2, 2, 0.2});
    tour.key({2, 3, 1.5}, {1, 3, 1.5});
    tour.startPath();
    tour.key({8, 0, 1}, {9, 0, 1});
    tour.key({8, 1, 1}, {7, 1, 1});
    return tour;
}

/// Each key frame occurs in order and exactly once, at its position, with its target in the middle
/// of the image.
void expectEveryKey(const Tour& tour, const Trajectory& trajectory) {
    int next = 0;
    for (const TrajectoryFrame& frame : trajectory.frames) {
        if (frame.position_point < 0) continue;
        ASSERT_EQ(frame.position_point, next++);
        const std::size_t i = frame.position_point;
        EXPECT_LT((frame.pose.position - tour.points[i].pose.position).norm(), 1e-9);
        const Vector3d wish = (tour.targets[i].position - frame.pose.position).normalized();
        EXPECT_LT((frame.pose.forward() - wish).norm(), 1e-9);
    }
    EXPECT_EQ(next, static_cast<int>(tour.points.size()));
}

void expectLimitsKept(const Trajectory& trajectory, const TimingParams& params) {
    const MotionLimits limits = motionLimits(params);
    for (std::size_t i = 1; i < trajectory.frames.size(); ++i) {
        const TrajectoryFrame& a = trajectory.frames[i - 1];
        const TrajectoryFrame& b = trajectory.frames[i];
        const double step_s = b.time_s - a.time_s;
        if (params.max_frames == 0) {
            EXPECT_NEAR(step_s, trajectory.frame_interval_s, 1e-9);
        }
        if (a.path != b.path) continue;
        const double step_m = (b.pose.position - a.pose.position).norm();
        EXPECT_LE(step_m, step_s * limits.speed_mps * 1.001) << i;
        EXPECT_LE(angle(a.pose.rotation, b.pose.rotation), step_s * limits.turn_rps * 1.02) << i;
    }
}

}  // namespace

TEST(BetweenOrientations, StaysRollFreeAndEndsExactly) {
    const Quaterniond from = looking(0, 0);
    const Quaterniond to = looking(90, -60);
    const Turn turn(from, to);
    EXPECT_LT(angle(turn.at(0.0), from), 1e-7);
    EXPECT_LT(angle(turn.at(turn.angle()), to), 1e-7);
    Quaterniond last = from;
    for (int i = 1; i <= 100; ++i) {
        const Quaterniond now = turn.at(turn.angle() * i / 100.0);
        expectRollFree(now);
        // Interpolation is by angle: even steps give even turns.
        EXPECT_NEAR(angle(last, now), turn.angle() / 100.0, 0.02 * turn.angle() / 100.0);
        last = now;
    }
}

// Between steep views the shortest turn passes the vertical, where the heading would spin.
TEST(BetweenOrientations, NeverSpinsTheHeading) {
    constexpr int kSteps = 400;
    for (const double from_pitch : {-85.0, -75.0, -60.0, 0.0, 60.0, 80.0}) {
        for (const double to_pitch : {-85.0, -75.0, -60.0, 0.0, 60.0, 80.0}) {
            for (const double yaw : {150.0, 175.0, 180.0, -178.0}) {
                const Quaterniond from = looking(0, from_pitch);
                const Quaterniond to = looking(yaw, to_pitch);
                const Turn turn(from, to);
                double largest = 0.0;
                Quaterniond last = from;
                for (int i = 1; i <= kSteps; ++i) {
                    const Quaterniond now = turn.at(turn.angle() * i / kSteps);
                    expectRollFree(now);
                    largest = std::max(largest, angle(last, now));
                    last = now;
                }
                // At most three times as fast as an even turn by 180 degrees.
                EXPECT_LE(largest, 3.0 * std::numbers::pi / kSteps)
                    << from_pitch << " to " << to_pitch << ", yaw " << yaw;
            }
        }
    }
}

TEST(TimeTrajectory, StandsOnEveryKeyWithinTheLimits) {
    const Tour tour = threeKeysAndTwo();
    for (const double speed : {0.2, 0.5, 5.0}) {
        TimingParams params;
        params.max_speed_mps = speed;
        const auto trajectory = tour.timed(params);
        ASSERT_TRUE(trajectory.has_value());
        EXPECT_NEAR(trajectory->frame_interval_s, 0.1, 1e-12);
        expectEveryKey(tour, *trajectory);
        expectLimitsKept(*trajectory, params);
    }
}

// A budget leaves out frames of the same motion, and none if it is large enough.
TEST(TimeTrajectory, ABudgetOfFramesKeepsTheMotionAndEveryKey) {
    const Tour tour = threeKeysAndTwo();
    const auto all = tour.timed({});
    ASSERT_TRUE(all.has_value());
    for (const std::size_t budget : {5, 6, 9, 20, 60, 10'000}) {
        TimingParams params;
        params.max_frames = static_cast<int>(budget);
        const auto trajectory = tour.timed(params);
        ASSERT_TRUE(trajectory.has_value()) << budget;
        EXPECT_EQ(trajectory->frames.size(), std::min(budget, all->frames.size()));
        expectEveryKey(tour, *trajectory);
        expectLimitsKept(*trajectory, params);
        const std::vector<std::size_t> order = motionOrder(*trajectory);
        ASSERT_EQ(order.size(), all->frames.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            const TrajectoryFrame& frame = motionFrame(*trajectory, order[i]);
            EXPECT_EQ(frame.time_s, all->frames[i].time_s);
            EXPECT_EQ(frame.pose, all->frames[i].pose);
        }
        EXPECT_EQ(trajectory->frames.back().time_s, all->frames.back().time_s);
        const auto read = trajectoryFromJson(trajectoryJson(*trajectory));
        ASSERT_TRUE(read);
        EXPECT_EQ(trajectoryJson(*read), trajectoryJson(*trajectory));
        EXPECT_EQ(motionOrder(*read), order);
    }
    TimingParams params;
    params.max_frames = 4;
    EXPECT_FALSE(tour.timed(params).has_value());
}

TEST(TimeTrajectory, ABudgetOfFramesIsDistributedByWeight) {
    Tour tour = threeKeysAndTwo();
    const std::size_t all = tour.timed({})->frames.size();
    TimingParams params;
    params.max_frames = static_cast<int>(all / 2);
    const auto framesOfFirstWay = [&] {
        const auto trajectory = tour.timed(params);
        EXPECT_EQ(trajectory->frames.size(), all / 2);
        return std::ranges::find(trajectory->frames, 1, &TrajectoryFrame::position_point) -
               trajectory->frames.begin();
    };
    const auto before = framesOfFirstWay();
    tour.paths.front().keys[1].frame_weight = 4.0;
    EXPECT_GT(framesOfFirstWay(), 1.5 * static_cast<double>(before));
}

TEST(TimeTrajectory, StopsAtTheTipOfACurveThatTurnsBack) {
    for (const double aside : {0.0, 1e-9, 1e-3}) {
        Tour tour;
        tour.startPath();
        tour.key({0, 0, 1}, {1, 2, 1});
        tour.curve({2, 0, 1}, {0, aside, 1}, 0.2, Vector3d(2, 2, 1));
        tour.key({-1, aside, 1}, {-1, 2, 1});
        for (const int max_frames : {0, 12}) {
            TimingParams params;
            params.max_frames = max_frames;
            const auto trajectory = tour.timed(params);
            ASSERT_TRUE(trajectory) << describe(trajectory.error());
            expectEveryKey(tour, *trajectory);
            expectLimitsKept(*trajectory, params);
            // 4.9 m at 0.5 m/s, with one stop and six turns.
            EXPECT_LT(trajectory->frames.back().time_s, 40.0);
        }
    }
}

TEST(TimeTrajectory, TurnsOnTheSpotBetweenTwoKeysAtOnePlace) {
    const Vector3d place(1.5, 2.5, 1.2);
    Tour tour;
    tour.startPath();
    tour.key(place, place + Vector3d(1, 0, 0));
    tour.key(place, place + Vector3d(0, 1, -0.5));
    const auto trajectory = tour.timed({});
    ASSERT_TRUE(trajectory.has_value());
    EXPECT_GT(trajectory->frames.size(), 3U);
    for (const TrajectoryFrame& frame : trajectory->frames) {
        EXPECT_LT((frame.pose.position - place).norm(), 1e-9);
    }
    expectEveryKey(tour, *trajectory);
    expectLimitsKept(*trajectory, {});
}

TEST(TimeTrajectory, TurnsOnTheSpotAtTheEndsAndInTheMiddleOfAPath) {
    Tour tour;
    tour.startPath();
    for (const double x : {0.0, 1.0, 2.0}) {
        tour.key({x, 1, 1}, {x + 1.0, 1, 1});
        tour.key({x, 1, 1}, {x, 3, 1});
    }
    const auto trajectory = tour.timed({});
    ASSERT_TRUE(trajectory.has_value());
    expectEveryKey(tour, *trajectory);
    expectLimitsKept(*trajectory, {});
}

}  // namespace dollytrack::planning::time_trajectory_test
