#include "planning/timing/motion_limits.h"
#include "engine/core/random.h"
#include "planning/plan_params.h"
#include "planning/timing/clip.h"
#include "planning/timing/time_trajectory.h"
#include "tests/planning/timing/tour_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning::motion_limits_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using test_support::Tour;

constexpr double kRadians = std::numbers::pi / 180.0;

Vector3d anywhere(Random& random) {
    return {random.uniform(0.0, 6.0), random.uniform(0.0, 6.0), random.uniform(0.3, 2.2)};
}

/// Random key frames and corners: rounded corners, stops, turns on the spot, views straight down.
Tour randomTour(int seed) {
    Random random(static_cast<std::uint64_t>(seed));
    Tour tour;
    tour.startPath();
    Vector3d place = anywhere(random);
    tour.key(place, anywhere(random));
    const auto legs = 4 + random.below(8);
    for (std::uint32_t i = 0; i < legs; ++i) {
        const double length = random.below(3) == 0 ? random.uniform(0.02, 0.2) : 2.0;
        const Vector3d next = place + length * (anywhere(random) - place).normalized();
        switch (random.below(5)) {
            case 0:
                tour.key(place, place - Vector3d(0.0, 0.0, 1.0));
                break;
            case 1:
                tour.stop(next);
                place = next;
                break;
            case 2: {
                const Vector3d after =
                    next + random.uniform(0.1, 1.0) * (anywhere(random) - next).normalized();
                tour.curve(next, after, 0.5, anywhere(random));
                place = after;
                break;
            }
            default:
                tour.key(next, anywhere(random));
                place = next;
        }
    }
    tour.key(place + Vector3d(0.3, 0.0, 0.0), anywhere(random));
    return tour;
}

/// Rotation between two orientations in the camera's own axes, rad.
Vector3d rotationBetween(const Quaterniond& from, const Quaterniond& to) {
    const Eigen::AngleAxisd turn(from.conjugate() * to);
    return turn.angle() <= std::numbers::pi
               ? Vector3d(turn.angle() * turn.axis())
               : Vector3d((turn.angle() - 2.0 * std::numbers::pi) * turn.axis());
}

/// Checks the limits with finite differences of the emitted frames.
void expectKept(const Trajectory& trajectory, const MotionLimits& limits, const std::string& what) {
    const auto& frames = trajectory.frames;
    const auto since = [&](std::size_t i) { return frames[i].time_s - frames[i - 1].time_s; };
    const auto velocity = [&](std::size_t i) -> Vector3d {
        return (frames[i].pose.position - frames[i - 1].pose.position) / since(i);
    };
    const auto rate = [&](std::size_t i) -> Vector3d {
        return rotationBetween(frames[i - 1].pose.rotation, frames[i].pose.rotation) / since(i);
    };
    double speed = 0.0;
    double acceleration = 0.0;
    double turn = 0.0;
    double turn_acceleration = 0.0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        if (frames[i].path != frames[i - 1].path) continue;
        speed = std::max(speed, velocity(i).norm());
        turn = std::max(turn, rate(i).norm());
        if (i < 2 || frames[i - 2].path != frames[i].path) continue;
        const double dt =
            0.5 * (since(i) + since(i - 1));  // between the midpoints of the two steps
        acceleration = std::max(acceleration, (velocity(i) - velocity(i - 1)).norm() / dt);
        turn_acceleration = std::max(turn_acceleration, (rate(i) - rate(i - 1)).norm() / dt);
    }
    EXPECT_LE(speed, limits.speed_mps * 1.0001) << what;
    EXPECT_LE(acceleration, limits.acceleration_mps2 * 1.02) << what;
    EXPECT_LE(turn, limits.turn_rps * 1.01) << what;
    EXPECT_LE(turn_acceleration, limits.turn_acceleration_rps2 * 1.05) << what;
}

/// The shortest time along a path from rest to rest, on a grid of 1 mm, with tangential and normal
/// acceleration limited together; the curvature is computed from the path's points.
double slowLeastTime(const SmoothPath& path, const MotionLimits& limits) {
    constexpr double kStep = 0.001;
    const auto count = static_cast<std::size_t>(path.length_m / kStep);
    const double step = path.length_m / static_cast<double>(count);
    std::vector<double> bend(count + 1, 0.0);
    std::vector<double> speed(count + 1, limits.speed_mps);
    for (std::size_t i = 5; i + 5 <= count; ++i) {
        const Vector3d a = path.at(step * static_cast<double>(i - 5));
        const Vector3d b = path.at(step * static_cast<double>(i));
        const Vector3d c = path.at(step * static_cast<double>(i + 5));
        bend[i] = (a - 2.0 * b + c).norm() / (25.0 * step * step);
        if (bend[i] > 1e-6) {
            speed[i] = std::min(speed[i], std::sqrt(limits.acceleration_mps2 / bend[i]));
        }
    }
    speed.front() = speed.back() = 0.0;
    const auto reach = [&](double from, double bent) {
        const double across = std::min(from * from * bent, limits.acceleration_mps2);
        const double along =
            std::sqrt(limits.acceleration_mps2 * limits.acceleration_mps2 - across * across);
        return std::sqrt(from * from + 2.0 * along * step);
    };
    for (std::size_t i = 1; i <= count; ++i) {
        speed[i] = std::min(speed[i], reach(speed[i - 1], bend[i - 1]));
    }
    for (std::size_t i = count; i > 0; --i) {
        speed[i - 1] = std::min(speed[i - 1], reach(speed[i], bend[i]));
    }
    double time = 0.0;
    for (std::size_t i = 1; i <= count; ++i) time += 2.0 * step / (speed[i - 1] + speed[i]);
    return time;
}

}  // namespace

TEST(MotionLimits, HoldOnTheEmittedFramesOfRandomPaths) {
    for (int seed = 0; seed < 60; ++seed) {
        const Tour tour = randomTour(seed);
        for (const MotionPreset preset :
             {MotionPreset::Easy, MotionPreset::Medium, MotionPreset::Hard}) {
            for (const double frame_rate : {3.0, 10.0, 30.0}) {
                TimingParams params;
                params.motion_preset = preset;
                params.frame_rate = frame_rate;
                const auto trajectory = tour.timed(params);
                ASSERT_TRUE(trajectory.has_value());
                expectKept(*trajectory, motionLimits(params),
                           "seed " + std::to_string(seed) + ", preset " +
                               std::to_string(static_cast<int>(preset)) + ", " +
                               std::to_string(frame_rate) + " frames a second");
                if (HasFailure()) return;
            }
        }
    }
}

TEST(MotionLimits, HoldUnderABudgetOfFrames) {
    for (int seed = 0; seed < 20; ++seed) {
        const Tour tour = randomTour(seed);
        for (const int budget : {20, 40, 80}) {
            TimingParams params;
            params.max_frames = budget;
            const auto trajectory = tour.timed(params);
            ASSERT_TRUE(trajectory.has_value());
            EXPECT_LE(trajectory->frames.size(), static_cast<std::size_t>(budget));
            expectKept(*trajectory, motionLimits(params), "seed " + std::to_string(seed));
        }
    }
}

TEST(MotionLimits, TakeHardlyLongerThanTheShortestTime) {
    for (const double set_back : {0.05, 0.2, 0.45, 0.9}) {
        for (const MotionPreset preset :
             {MotionPreset::Easy, MotionPreset::Medium, MotionPreset::Hard}) {
            // No key frame at the corner: only the limits decide.
            Tour tour;
            tour.startPath();
            tour.key({0, 0, 1}, {9, 9, 1});
            tour.curve({3, 0, 1}, {3, 2, 1}, set_back, std::nullopt);
            tour.key({3, 2, 1}, {9, 9, 1});
            TimingParams params;
            params.motion_preset = preset;
            params.frame_rate = 100.0;
            const auto trajectory = tour.timed(params);
            ASSERT_TRUE(trajectory.has_value());
            const double least = slowLeastTime(tour.paths.front(), motionLimits(params));
            EXPECT_GE(trajectory->frames.back().time_s, least * 0.999);
            EXPECT_LE(trajectory->frames.back().time_s, least * 1.08 + 0.01)
                << "set-back " << set_back << ", preset " << static_cast<int>(preset);
        }
    }
}

// 3 m from rest to rest: 0.5 s to gain 0.5 m/s at 1 m/s2, 5.5 s at that speed, 0.5 s to lose it.
TEST(MotionLimits, GiveTheExactTimeOfAStraightWay) {
    Tour tour;
    tour.startPath();
    tour.key({0, 0, 1}, {0, 9, 1});
    tour.key({3, 0, 1}, {3, 9, 1});
    const auto trajectory = tour.timed({});
    ASSERT_TRUE(trajectory.has_value());
    EXPECT_EQ(trajectory->frames.size(), 66U);
}

TEST(MotionLimits, DoNotStopAtAKeyOnAStraightWay) {
    Tour tour;
    tour.startPath();
    for (int i = 0; i <= 4; ++i) tour.key({i * 1.0, 0, 1}, {i * 1.0, 9, 1});
    const auto trajectory = tour.timed({});
    ASSERT_TRUE(trajectory.has_value());
    for (std::size_t i = 10; i + 10 < trajectory->frames.size(); ++i) {
        const double step =
            (trajectory->frames[i].pose.position - trajectory->frames[i - 1].pose.position).norm();
        EXPECT_GT(step, 0.03) << i;  // 0.3 m/s
    }
}

TEST(MotionLimits, OwnLimitsComeBeforeThePresets) {
    TimingParams params;
    params.motion_preset = MotionPreset::Hard;
    const MotionLimits hard = motionLimits(params);
    params.max_speed_mps = 0.3;
    EXPECT_EQ(motionLimits(params).speed_mps, 0.3);
    EXPECT_EQ(motionLimits(params).turn_rps, hard.turn_rps);
    params.motion_preset = MotionPreset::Custom;
    EXPECT_EQ(motionLimits(params).speed_mps, 0.3);
    EXPECT_GT(motionLimits(params).turn_rps, 1e3);
}

// A view straight down has only the heading of its camera: the turn must not jump to another.
TEST(MotionLimits, TurnSteadilyToAViewStraightDown) {
    Tour tour;
    tour.startPath();
    tour.key({0, 0, 1}, {5, -1, 1});
    tour.key({0.5, 0, 1}, {0.5, 0, 0});
    tour.key({1, 0, 1}, {-5, 0.5, 1});
    TimingParams params;
    const auto trajectory = tour.timed(params);
    ASSERT_TRUE(trajectory.has_value());
    expectKept(*trajectory, motionLimits(params), "down");
}

TEST(FrameRateNote, TellsOfTheSingleFrameOfABudget) {
    Trajectory trajectory;
    trajectory.frames.resize(1);
    TimingParams params;
    params.max_frames = 12;
    EXPECT_EQ(frameRateNote(trajectory, params),
              "only 1 of max_frames=12 frames is used: no second view fits; raise max_frames");
    params.max_frames = 1;
    EXPECT_EQ(frameRateNote(trajectory, params), "");
}

}  // namespace dollytrack::planning::motion_limits_test
