#include "engine/core/random.h"
#include "planning/pipeline/pipeline.h"
#include "planning/timing/turn.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning::pitch_band_test {
namespace {

using test_support::planOf;

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Elevation of a frame's viewing direction in degrees, from its rotation matrix.
double pitchOf(const Pose& pose) {
    const Eigen::Matrix3d world_from_camera = pose.rotation.toRotationMatrix();
    return std::asin(std::clamp(world_from_camera(2, 2), -1.0, 1.0)) * kDegrees;
}

std::pair<double, double> pitchesOf(const Plan& plan) {
    double low = 90.0;
    double high = -90.0;
    for (const TrajectoryFrame& frame : plan.trajectory.frames) {
        low = std::min(low, pitchOf(frame.pose));
        high = std::max(high, pitchOf(frame.pose));
        // The frame's target lies in its viewing direction.
        const Eigen::Vector3d to = frame.target_in_world - frame.pose.position;
        EXPECT_LT(angleBetween(to, frame.pose.forward()), 1e-6);
    }
    return {low, high};
}

PinnedPoint pinAt(const std::string& name, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return {name, lookAt(from, to), {}};
}

}  // namespace

TEST(PitchBand, NoFrameLooksSteeper) {
    const Scene scene = test::furnishedRoom();
    const auto free = planOf(scene);
    EXPECT_LT(pitchesOf(*free).first, -20.0) << "nothing looks down: the test tests nothing";
    for (const auto& [low, high] : {std::pair(-15.0, 15.0), {-90.0, -10.0}, {0.0, 0.0}}) {
        for (const PathMode mode : {PathMode::Tour, PathMode::LongestBranch}) {
            for (const ShakeKind shake : {ShakeKind::None, ShakeKind::Handheld}) {
                PlanParams params;
                params.constraints.min_pitch_deg = low;
                params.constraints.max_pitch_deg = high;
                params.path.path_mode = mode;
                params.shake.shake = shake;
                params.shake.shake_amplitude_deg = 8.0;
                const auto plan = planOf(scene, params);
                ASSERT_GT(plan->trajectory.frames.size(), 5U);
                const auto [lowest, highest] = pitchesOf(*plan);
                EXPECT_GE(lowest, low - 1e-6);
                EXPECT_LE(highest, high + 1e-6);
                EXPECT_GE(plan->capture_metrics.captured, 3);
            }
        }
    }
}

TEST(PitchBand, RandomRoomsAndBandsKeepIt) {
    Random random(11);
    for (int round = 0; round < 6; ++round) {
        test::SceneBuilder builder;
        builder.room({0, 0, 0}, {5, 4, 2.6});
        for (int i = 0; i < 8; ++i) {
            const Eigen::Vector3d size(random.uniform(0.1, 0.6), random.uniform(0.1, 0.6),
                                       random.uniform(0.1, 1.2));
            builder.object("box " + std::to_string(i))
                .box({random.uniform(0.5, 4.5), random.uniform(0.5, 3.5),
                      random.uniform(0.5 * size.z(), 2.6 - 0.5 * size.z())},
                     size, random.uniform(0.0, 3.0));
        }
        PlanParams params;
        params.seed = round;
        params.constraints.min_pitch_deg = random.uniform(-50.0, 0.0);
        params.constraints.max_pitch_deg =
            params.constraints.min_pitch_deg + random.uniform(0.0, 40.0);
        const auto plan = planOf(builder.build(), params);
        const auto [lowest, highest] = pitchesOf(*plan);
        EXPECT_GE(lowest, params.constraints.min_pitch_deg - 1e-6) << round;
        EXPECT_LE(highest, params.constraints.max_pitch_deg + 1e-6) << round;
    }
}

// The narrowest possible band: from the pitch of one end to that of the other.
TEST(PitchBand, TurnsStayWithinItBetweenAnyTwoViews) {
    Random random(5);
    for (int round = 0; round < 3000; ++round) {
        const double first = random.uniform(-1.4, 1.4);
        const double second = random.uniform(-1.4, 1.4);
        const PitchBand band{std::min(first, second), std::max(first, second)};
        const auto view = [&](double pitch) {
            const double yaw = random.uniform(-3.1, 3.1);
            return lookAlong({std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch),
                              std::sin(pitch)});
        };
        const Eigen::Quaterniond from = view(first);
        const Eigen::Quaterniond to = view(second);
        const Turn turn(from, to, band);
        for (int i = 0; i <= 200; ++i) {
            const double pitch = pitchOf({{}, turn.at(turn.angle() * i / 200.0)});
            ASSERT_GE(pitch, band.lowest * kDegrees - 1e-6) << round;
            ASSERT_LE(pitch, band.highest * kDegrees + 1e-6) << round;
        }
        EXPECT_EQ(turn.at(0.0).coeffs(), from.coeffs());
        EXPECT_EQ(turn.at(turn.angle()).coeffs(), to.coeffs());
    }
}

TEST(PitchBand, APinnedPointOutsideItIsRefusedAndAnEmptyOneIsAnError) {
    PlanParams params;
    params.constraints.min_pitch_deg = -10.0;
    PlanEdits edits;
    edits.pinned = {pinAt("down", {1.5, 1.0, 1.8}, {1.6, 1.0, 0.2})};
    const auto plan = planOf(test::furnishedRoom(), params, edits);
    ASSERT_EQ(plan->refused_pins.size(), 1U);
    EXPECT_EQ(plan->refused_pins[0].verdict, Verdict::PitchBand);
    EXPECT_NE(plan->refused_pins[0].reason.find("degrees down"), std::string::npos);
    params.constraints.max_pitch_deg = -20.0;
    const auto none = Pipeline(std::make_shared<const Scene>(test::furnishedRoom()))
                          .run(params, edits, JobContext{});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::Usage);
    EXPECT_EQ(none.error().where, "max_pitch_deg");
}

}  // namespace dollytrack::planning::pitch_band_test
