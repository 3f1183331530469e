#include "planning/motions/camera_moves.h"

#include "engine/plan/motion_metrics.h"
#include "planning/baselines/baseline_scene.h"
#include "planning/timing/motion_limits.h"
#include "tests/planning/support/slow_checker.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning::camera_moves_test {
namespace {

using Eigen::Vector3d;

/// A stool in the middle of a room.
Scene roomWithStool() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 6, 2.6});
    builder.object("stool").box({3.0, 3.0, 0.3}, {0.4, 0.4, 0.6});
    return builder.build();
}

MappedScene mapped(Scene scene) {
    auto made = mapScene(std::make_shared<const Scene>(std::move(scene)), {}, {}, {});
    EXPECT_TRUE(made.has_value());
    return std::move(*made);
}

Result<CameraMove> made(const MappedScene& scene, const std::string& text) {
    return parseMove(text).and_then(
        [&](const MoveRequest& request) { return makeMove(scene, {}, request, {}); });
}

ErrorCode codeOf(const MappedScene& scene, const std::string& text) {
    const auto result = made(scene, text);
    EXPECT_FALSE(result.has_value()) << text;
    return result ? ErrorCode::Failed : result.error().code;
}

/// Checks what holds for every move: free, within the limits, from rest to rest.
void expectSound(const MappedScene& scene, const Trajectory& trajectory) {
    const auto& frames = trajectory.frames;
    ASSERT_GT(frames.size(), 10U);
    const test_support::SlowChecker checker(*scene.scene);
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        EXPECT_NEAR(frames[i + 1].time_s - frames[i].time_s, trajectory.frame_interval_s, 1e-9);
        const Vector3d move = frames[i + 1].pose.position - frames[i].pose.position;
        for (int k = 0; k < 10; ++k) {
            EXPECT_GE(checker.distance(frames[i].pose.position + 0.1 * k * move), 0.1 - 1e-6);
        }
    }
    const MotionLimits limits = motionLimits({});
    const MotionMetrics motion = measureMotion(trajectory);
    EXPECT_LE(motion.speed_mps.max, 1.03 * limits.speed_mps);
    EXPECT_LE(motion.turn_dps.max, 1.03 * limits.turn_rps * 180.0 / std::numbers::pi);
    const double first = (frames[1].pose.position - frames[0].pose.position).norm();
    EXPECT_LE(first, 0.5 * limits.speed_mps * trajectory.frame_interval_s);
}

/// Angle between the viewing direction and a point, at most, rad.
double largestMiss(const Trajectory& trajectory, const Vector3d& point) {
    double largest = 0.0;
    for (const TrajectoryFrame& frame : trajectory.frames) {
        largest =
            std::max(largest, angleBetween(frame.pose.forward(), point - frame.pose.position));
    }
    return largest;
}

}  // namespace

TEST(CameraMoves, OrbitsAroundAnObject) {
    const MappedScene scene = mapped(roomWithStool());
    const auto move = made(scene, "orbit:target=stool,radius=1.5,height=1");
    ASSERT_TRUE(move) << describe(move.error());
    expectSound(scene, move->trajectory);
    for (const TrajectoryFrame& frame : move->trajectory.frames) {
        const Vector3d& position = frame.pose.position;
        EXPECT_NEAR(std::hypot(position.x() - 3.0, position.y() - 3.0), 1.5, 0.01);
        EXPECT_NEAR(position.z(), 1.0, 1e-6);
    }
    EXPECT_LT(largestMiss(move->trajectory, {3.0, 3.0, 0.3}), 1e-6);
    EXPECT_GE(move->trajectory.frames.back().time_s, 3.0 * std::numbers::pi / 0.5);
    const auto& frames = move->trajectory.frames;
    EXPECT_NEAR((frames.front().pose.position - frames.back().pose.position).norm(), 0.0, 0.06);
}

TEST(CameraMoves, MakesEveryKindWithDefaults) {
    const MappedScene scene = mapped(roomWithStool());
    for (const char* text : {"orbit:target=stool", "arc:target=stool", "dolly:target=stool",
                             "crane:target=stool,radius=1.2", "dolly:from=1;1;1,to=1;5;1",
                             "walk:from=1;3;1.2,to=5;3;1.2", "arc:target=st*,arc=45,time=20",
                             "orbit", "arc", "dolly", "crane", "walk", "orbit:center=3;3;0.3"}) {
        SCOPED_TRACE(text);
        const auto move = made(scene, text);
        ASSERT_TRUE(move) << describe(move.error());
        expectSound(scene, move->trajectory);
        if (std::string(text).find("stool") == std::string::npos) continue;
        EXPECT_LT(largestMiss(move->trajectory, {3.0, 3.0, 0.3}), 1e-6);
    }
}

// Two shelves stand where the camera would fly.
TEST(CameraMoves, AnOrbitAvoidsObstaclesByItsRadiusAndHeight) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 6, 2.6});
    builder.object("stool").box({3.0, 3.0, 0.3}, {0.4, 0.4, 0.6});
    builder.object("shelf").box({3.0, 4.6, 1.3}, {3.0, 0.4, 2.6});
    builder.object("cupboard").box({3.0, 1.4, 1.3}, {3.0, 0.4, 2.6});
    const MappedScene scene = mapped(builder.build());
    const auto move = made(scene, "orbit:target=stool,radius=2,height=1");
    ASSERT_TRUE(move) << describe(move.error());
    expectSound(scene, move->trajectory);
    EXPECT_NE(move->note.find("radius"), std::string::npos) << move->note;
    double turned = 0.0;
    const auto& frames = move->trajectory.frames;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const Vector3d a = frames[i - 1].pose.position - Vector3d(3.0, 3.0, 1.0);
        const Vector3d b = frames[i].pose.position - Vector3d(3.0, 3.0, 1.0);
        turned += std::abs(std::remainder(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()),
                                          2.0 * std::numbers::pi));
    }
    EXPECT_GT(turned, 1.9 * std::numbers::pi) << "all around, nearer";
    const auto fits = made(scene, "orbit:target=stool,radius=1,height=1");
    ASSERT_TRUE(fits) << describe(fits.error());
    EXPECT_TRUE(fits->note.empty());
}

/// Walls hold the camera back at all angles but the corners, where the wanted circle is free.
TEST(CameraMoves, AnOrbitAlongWallsTurnsSmoothly) {
    const MappedScene scene = mapped(roomWithStool());
    const auto move = made(scene, "orbit:target=stool,radius=3.1,height=1");
    ASSERT_TRUE(move.has_value());
    expectSound(scene, move->trajectory);
    double turned = 0.0;
    const auto& frames = move->trajectory.frames;
    for (std::size_t i = 2; i < frames.size(); ++i) {
        const Vector3d before = frames[i - 1].pose.position - frames[i - 2].pose.position;
        const Vector3d after = frames[i].pose.position - frames[i - 1].pose.position;
        if (before.norm() > 1e-4 && after.norm() > 1e-4) turned += angleBetween(before, after);
    }
    EXPECT_GT(turned, 1.6 * std::numbers::pi);
    EXPECT_LT(turned, 3.0 * std::numbers::pi);
}

TEST(CameraMoves, WalksAcrossTheOnlyRoom) {
    const MappedScene scene = mapped(roomWithStool());
    const auto move = made(scene, "walk");
    ASSERT_TRUE(move) << describe(move.error());
    const auto& frames = move->trajectory.frames;
    EXPECT_GT((frames.back().pose.position - frames.front().pose.position).norm(), 3.0);
}

/// A hall on a floor above a crawl space that the camera fits into, and a gallery over a part of
/// it.
TEST(CameraMoves, HeightsAreAboveTheFloorOnWhichOneWalks) {
    constexpr double kGround = -0.9;
    test::SceneBuilder builder;
    builder.room({0, 0, kGround}, {9, 6, 5.2});
    builder.object("hall floor", {.nyu40 = kNyuFloor, .role = Role::Structure})
        .box({4.5, 3.0, -0.05}, {8.4, 6.0, 0.1});  // gaps lead below it
    builder.object("gallery floor", {.nyu40 = kNyuFloor, .role = Role::Structure})
        .box({1.25, 3.0, 2.55}, {2.5, 6.0, 0.1});
    builder.object("stool").box({6.0, 3.0, 0.3}, {0.4, 0.4, 0.6});
    builder.object("vase").box({1.2, 3.0, 2.75}, {0.3, 0.3, 0.3});
    const MappedScene scene = mapped(builder.build());
    const auto walk = made(scene, "walk");
    ASSERT_TRUE(walk) << describe(walk.error());
    EXPECT_NEAR(walk->floor_z, 0.0, 0.02);
    for (const TrajectoryFrame& frame : walk->trajectory.frames) {
        EXPECT_GT(frame.pose.position.z(), 0.5);
    }
    const auto orbit = made(scene, "orbit:target=stool,radius=1.2,height=1");
    ASSERT_TRUE(orbit) << describe(orbit.error());
    EXPECT_NEAR(orbit->trajectory.frames.front().pose.position.z(), 1.0, 0.02);
    const auto above = made(scene, "arc:target=vase,radius=0.9,arc=45,height=1");
    ASSERT_TRUE(above) << describe(above.error());
    EXPECT_NEAR(above->floor_z, 2.6, 0.02);
}

TEST(CameraMoves, TheTextOfARequestIsReadBack) {
    MoveRequest request;
    request.kind = "walk";
    request.options["from"] = optionText(Vector3d(1.0, -2.25, 1.0 / 3.0));
    request.options["height"] = optionText(1.5);
    const std::string text = moveText(request);
    EXPECT_EQ(text, "walk:from=1;-2.25;0.333,height=1.5");
    const auto again = parseMove(text);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->options, request.options);
    const auto values = readMove(*again);
    ASSERT_TRUE(values);
    EXPECT_LT((*values->point("from") - Vector3d(1.0, -2.25, 0.333)).norm(), 1e-9);
    EXPECT_EQ(values->number("height", 0.0), 1.5);
    EXPECT_EQ(settingLabel("from_height"), "From height");
}

TEST(CameraMoves, WalksThroughTheDoor) {
    const MappedScene scene = mapped(test::twoRoomsWithDoor(0.9));
    const auto move = made(scene, "walk");
    ASSERT_TRUE(move) << describe(move.error());
    expectSound(scene, move->trajectory);
    const auto& frames = move->trajectory.frames;
    EXPECT_GT(std::abs(frames.back().pose.position.x() - frames.front().pose.position.x()), 2.0);
}

TEST(CameraMoves, RefusesWhatIsImpossible) {
    const MappedScene scene = mapped(roomWithStool());
    EXPECT_EQ(codeOf(scene, "orbitt:target=stool"), ErrorCode::Usage);
    EXPECT_EQ(codeOf(scene, "orbit:targets=stool"), ErrorCode::Usage);
    EXPECT_EQ(codeOf(scene, "orbit:target=stool,radius=wide"), ErrorCode::Usage);
    EXPECT_EQ(codeOf(scene, "orbit:target=stool,radius=-1"), ErrorCode::Usage);
    EXPECT_EQ(codeOf(scene, "orbit:target="), ErrorCode::Usage);
    EXPECT_EQ(codeOf(scene, "orbit:radius=2000"), ErrorCode::Usage);
    EXPECT_EQ(codeOf(scene, "orbit:target=stool,center=1;1;1"), ErrorCode::Usage);
    EXPECT_EQ(codeOf(scene, "dolly:from=1;1,to=1;5;1"), ErrorCode::Usage);
    EXPECT_EQ(codeOf(scene, "dolly:from=1;1;1"), ErrorCode::Usage);
    EXPECT_EQ(codeOf(scene, "orbit:target=sofa"), ErrorCode::BadInput);
    EXPECT_EQ(codeOf(scene, "orbit:target=stool,radius=900"), ErrorCode::BadInput);
    const auto half = made(scene, "walk:from=1;1;1");
    ASSERT_FALSE(half);
    EXPECT_EQ(half.error().where, "from, to") << "for the window's labels";
    EXPECT_NE(parseMove("orbitt").error().message.find("'orbit'"), std::string::npos);
}

TEST(CameraMoves, HelpNamesEveryKindAndOption) {
    const std::string help = moveHelp();
    for (const MoveKind& kind : moveKinds()) {
        EXPECT_NE(help.find(std::string(kind.name) + ":"), std::string::npos) << kind.name;
        for (const MoveSetting& setting : kind.settings) {
            EXPECT_NE(help.find(std::string(setting.name) + "="), std::string::npos);
            EXPECT_FALSE(setting.info.text.empty()) << setting.name;
        }
    }
}

}  // namespace dollytrack::planning::camera_moves_test
