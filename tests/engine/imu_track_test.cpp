#include "engine/camera/imu_track.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::imu_track_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// A walk with sway in all directions.
Pose walk(double t) {
    const Vector3d place(0.5 * t, 0.8 * std::sin(0.7 * t), 1.2 + 0.1 * std::sin(2.1 * t));
    const double yaw = 1.1 * std::sin(0.4 * t) + 0.3 * t;
    const double pitch = -0.3 + 0.4 * std::sin(0.9 * t);
    return {place, lookAlong({std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch),
                              std::sin(pitch)})};
}

std::vector<TrajectoryFrame> sampled(Pose (*pose)(double), double interval_s, int count) {
    std::vector<TrajectoryFrame> frames(count);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        frames[i].time_s = 3.0 + interval_s * static_cast<double>(i);
        frames[i].pose = pose(interval_s * static_cast<double>(i));
    }
    return frames;
}

std::vector<ImuSample> trackOf(const std::vector<TrajectoryFrame>& frames, double rate_hz) {
    return imuTrack(PoseSpline(frames), rate_hz, frames.front().time_s, frames.back().time_s);
}

/// A horizontal circle of 1 m around the origin at 1 rad/s, looking outwards.
Pose circle(double t) {
    const Vector3d out(std::cos(t), std::sin(t), 0.0);
    return {out, lookAlong(out)};
}

}  // namespace

TEST(ImuTrack, AtRestFeelsGravityUpwardsInTheCamerasAxes) {
    std::vector<TrajectoryFrame> frames(5);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        frames[i].time_s = 0.1 * static_cast<double>(i);
        frames[i].pose = {{1, 2, 3}, lookAlong({1, 1, 0})};
    }
    const auto track = trackOf(frames, 100.0);
    ASSERT_EQ(track.size(), 41U);
    for (const ImuSample& sample : track) {
        EXPECT_LT(sample.rate_rps.norm(), 1e-9);
        // y is down in the camera frame.
        EXPECT_LT((sample.specific_force_mps2 - Vector3d(0, -9.80665, 0)).norm(), 1e-9);
    }
}

// Looking outwards on a circle: rotation about the vertical, acceleration backwards to the centre.
TEST(ImuTrack, OnACircleFeelsItsCentre) {
    const auto track = trackOf(sampled(circle, 0.05, 100), 200.0);
    ASSERT_EQ(track.size(), 991U);
    for (std::size_t i = 50; i + 50 < track.size(); ++i) {
        EXPECT_LT((track[i].rate_rps - Vector3d(0, -1, 0)).norm(), 1e-4);
        EXPECT_LT((track[i].specific_force_mps2 - Vector3d(0, -9.80665, -1)).norm(), 2e-3);
    }
}

// Half a minute of dead reckoning from the first pose, with the samples only.
TEST(ImuTrack, IntegratesBackToThePoses) {
    const auto frames = sampled(walk, 0.1, 301);
    constexpr double kRate = 400.0;
    const auto track = trackOf(frames, kRate);
    ASSERT_EQ(track.size(), 12001U);
    Quaterniond rotation = frames[0].pose.rotation;
    Vector3d position = frames[0].pose.position;
    // From walk(), not from the track.
    Vector3d velocity = (walk(1e-4).position - walk(-1e-4).position) / 2e-4;
    double worst = 0.0;
    double worst_turn = 0.0;
    for (std::size_t i = 0; i + 1 < track.size(); ++i) {
        const double dt = track[i + 1].time_s - track[i].time_s;
        const Vector3d turn = 0.5 * dt * (track[i].rate_rps + track[i + 1].rate_rps);
        const Quaterniond next =
            rotation * Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
        const Vector3d gravity(0, 0, kGravity_mps2);
        const Vector3d a = rotation * track[i].specific_force_mps2 - gravity;
        const Vector3d b = next * track[i + 1].specific_force_mps2 - gravity;
        position += dt * velocity + dt * dt * (a / 3.0 + b / 6.0);
        velocity += 0.5 * dt * (a + b);
        rotation = next.normalized();
        if ((i + 1) % 40 != 0) continue;
        const Pose& truth = frames[(i + 1) / 40].pose;
        worst = std::max(worst, (position - truth.position).norm());
        worst_turn = std::max(worst_turn, angleBetween(rotation, truth.rotation));
    }
    EXPECT_LT(worst, 0.01);  // m, after 15 m and 30 s
    EXPECT_LT(worst_turn, 1e-4);
}

TEST(ImuTrack, APartHasTheSamplesOfTheWhole) {
    const auto frames = sampled(walk, 0.1, 41);
    const PoseSpline path(frames);
    const auto same = [](const ImuSample& a, const ImuSample& b) {
        return a.time_s == b.time_s && a.rate_rps == b.rate_rps &&
               a.specific_force_mps2 == b.specific_force_mps2;
    };
    for (const double rate_hz : {200.0, 33.0, 4.0}) {
        const auto whole = trackOf(frames, rate_hz);
        const double from = frames[7].time_s, to = frames[23].time_s;
        const auto part = imuTrack(path, rate_hz, from, to);
        const auto first = std::find_if(whole.begin(), whole.end(), [&](const ImuSample& sample) {
            return same(sample, part.front());
        });
        ASSERT_GE(std::distance(first, whole.end()), std::ssize(part));
        EXPECT_TRUE(std::equal(part.begin(), part.end(), first, same));
        // The samples reach both ends and extend beyond by less than an interval.
        EXPECT_LE(part.front().time_s, from + 1e-9);
        EXPECT_GT(part.front().time_s, from - 1.0 / rate_hz + 1e-9);
        EXPECT_GE(part.back().time_s, to - 1e-9);
        EXPECT_LT(part.back().time_s, to + 1.0 / rate_hz - 1e-9);
        // The frames of the part alone would give other samples.
        const auto alone = trackOf({frames.begin() + 7, frames.begin() + 24}, rate_hz);
        EXPECT_GT((alone.front().specific_force_mps2 - first->specific_force_mps2).norm(), 1e-3);
    }
}

TEST(ImuTrack, OfFewFramesIsFinite) {
    EXPECT_TRUE(trackOf(sampled(walk, 0.1, 3), 0.0).empty());
    for (const int frames : {2, 3, 4}) {
        const auto track = trackOf(sampled(walk, 0.1, frames), 100.0);
        EXPECT_EQ(track.size(), static_cast<std::size_t>(10 * (frames - 1) + 1));
        for (const ImuSample& sample : track) {
            EXPECT_TRUE(sample.rate_rps.allFinite() && sample.specific_force_mps2.allFinite());
        }
    }
}

}  // namespace dollytrack::imu_track_test
