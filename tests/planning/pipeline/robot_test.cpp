#include "planning/pipeline/pipeline.h"

#include "engine/geometry/ray_caster.h"
#include "planning/plan_params.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

namespace dollytrack::planning::robot_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;

PlanParams robot() {
    PlanParams params;
    params.body.camera_preset = CameraPreset::Robot;
    applyCameraPreset(params);
    return params;
}

/// A room with a platform of two steps, a table to drive beside but not below, a shelf that hangs
/// at the height of the body, a rug, and a pit too narrow to
/// drive in.
Scene roomForARobot() {
    test::SceneBuilder builder;
    const test::SceneBuilder::Look floor{kNyuFloor, Role::Structure, {0.6F, 0.6F, 0.6F}};
    builder.room({0, 0, -0.4}, {7, 4, 2.6});  // its floor is the bottom of the pit
    builder.object("floor", floor)
        .box({2.9, 2.0, -0.05}, {5.8, 4.0, 0.1})
        .box({6.65, 2.0, -0.05}, {0.7, 4.0, 0.1})
        .box({6.05, 1.25, -0.05}, {0.5, 2.5, 0.1});
    builder.object("step", floor).box({1.0, 3.6, 0.075}, {2.0, 0.8, 0.15});
    builder.object("platform", floor).box({1.0, 3.8, 0.15}, {2.0, 0.4, 0.3});
    builder.object("rug").box({3.0, 1.2, 0.005}, {1.2, 0.8, 0.01});
    builder.object("table")
        .box({3.4, 2.6, 0.72}, {1.2, 0.8, 0.04})
        .box({2.85, 2.25, 0.35}, {0.05, 0.05, 0.7})
        .box({3.95, 2.25, 0.35}, {0.05, 0.05, 0.7})
        .box({2.85, 2.95, 0.35}, {0.05, 0.05, 0.7})
        .box({3.95, 2.95, 0.35}, {0.05, 0.05, 0.7});
    builder.object("bench").box({5.1, 0.4, 0.3}, {0.9, 0.5, 0.1});
    builder.object("crate").box({0.4, 0.5, 0.25}, {0.5, 0.5, 0.5});
    builder.object("vase").box({6.7, 0.3, 0.2}, {0.25, 0.25, 0.4});
    builder.object("statue").box({1.0, 3.8, 0.6}, {0.2, 0.2, 0.6});
    return builder.build();
}

std::shared_ptr<const Plan> robotPlan(const Scene& scene, const PlanParams& params) {
    Pipeline pipeline(std::make_shared<const Scene>(scene));
    auto plan = pipeline.run(params, JobContext{});
    EXPECT_TRUE(plan.has_value()) << describe(plan.error());
    return plan ? *plan : std::make_shared<const Plan>();
}

/// Distance between a segment and a point in the plane.
double distanceInPlane(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
    const Vector2d along = b - a;
    const double share = along.squaredNorm() > 0.0
                             ? std::clamp(along.dot(p - a) / along.squaredNorm(), 0.0, 1.0)
                             : 0.0;
    return (a + share * along - p).norm();
}

/// Distance from the axis of an upright cylinder to the part of a triangle between its bottom and
/// its top, by brute force: the triangle is cut into thin level slices, each of them a segment.
double distanceOfSlices(const std::array<Vector3d, 3>& corners, const Vector2d& axis, double bottom,
                        double top) {
    constexpr int kSlices = 24;
    double low = std::max(bottom, std::min({corners[0].z(), corners[1].z(), corners[2].z()}));
    double high = std::min(top, std::max({corners[0].z(), corners[1].z(), corners[2].z()}));
    double least = 1e9;
    if (high < low) return least;
    for (int i = 0; i <= kSlices; ++i) {
        const double z = low + (high - low) * i / kSlices;
        std::vector<Vector2d> crossing;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d& a = corners[k];
            const Vector3d& b = corners[(k + 1) % 3];
            if (std::min(a.z(), b.z()) > z || std::max(a.z(), b.z()) < z) continue;
            if (a.z() == b.z()) {
                crossing.emplace_back(a.head<2>());
                crossing.emplace_back(b.head<2>());
                continue;
            }
            crossing.emplace_back((a + (b - a) * ((z - a.z()) / (b.z() - a.z()))).head<2>());
        }
        for (std::size_t k = 0; k < crossing.size(); ++k) {
            least = std::min(
                least, distanceInPlane(crossing[k], crossing[(k + 1) % crossing.size()], axis));
        }
        if (crossing.size() < 3) continue;  // a level triangle: the axis may go through its middle
        bool inside = true;
        double sign = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector2d edge = (corners[(k + 1) % 3] - corners[k]).head<2>();
            const Vector2d to = axis - corners[k].head<2>();
            const double side = edge.x() * to.y() - edge.y() * to.x();
            inside = inside && sign * side >= 0.0;
            if (side != 0.0) sign = side;
        }
        if (inside) least = 0.0;
    }
    return least;
}

double leastDistance(const Scene& scene, const Vector3d& camera, const PlanParams& params) {
    const double floor = camera.z() - params.body.camera_height_m;
    double least = 1e9;
    for (const Triangle& triangle : scene.triangles) {
        const std::array<Vector3d, 3> corners = {scene.positions[triangle[0]].cast<double>(),
                                                 scene.positions[triangle[1]].cast<double>(),
                                                 scene.positions[triangle[2]].cast<double>()};
        least = std::min(least,
                         distanceOfSlices(corners, camera.head<2>(), floor + params.body.max_step_m,
                                          floor + params.body.body_height_m));
    }
    return least;
}

/// All positions that the camera passes, at most `apart_m` apart.
void visitDriven(const Plan& plan, double apart_m, const std::function<void(const Vector3d&)>& at) {
    for (const SmoothPath& path : plan.smooth_paths) {
        const int steps = static_cast<int>(path.length_m / apart_m) + 1;
        for (int i = 0; i <= steps; ++i) at(path.at(path.length_m * i / steps));
    }
    for (const TrajectoryFrame& frame : plan.trajectory.frames) at(frame.pose.position);
}

/// Largest horizontal angle between the viewing direction and the direction of motion, over all
/// frames that the camera moves to.
double largestHeadingAngle(const Plan& plan) {
    double largest = 0.0;
    const auto& frames = plan.trajectory.frames;
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        if (frames[i].path != frames[i + 1].path) continue;
        const Vector3d moved = frames[i + 1].pose.position - frames[i].pose.position;
        if (moved.norm() < 1e-4) continue;
        for (const TrajectoryFrame* frame : {&frames[i], &frames[i + 1]}) {
            const Vector3d view = frame->pose.forward();
            const double cross = view.x() * moved.y() - view.y() * moved.x();
            largest =
                std::max(largest, std::abs(std::atan2(cross, view.head<2>().dot(moved.head<2>()))));
        }
    }
    return largest / kDegree;
}

TEST(Robot, DrivesAtItsHeightWithItsBodyClearAndLooksWhereItGoes) {
    const Scene scene = roomForARobot();
    const PlanParams params = robot();
    const auto plan = robotPlan(scene, params);
    ASSERT_GT(plan->trajectory.frames.size(), 40U);
    EXPECT_GE(plan->capture_metrics.captured, 4);
    for (const SmoothPath& path : plan->smooth_paths) EXPECT_EQ(path.collisions, 0);
    EXPECT_EQ(plan->trajectory_metrics.frame_collision_rate, 0.0);

    const RayCaster rays(scene);
    double least = 1e9;
    double lowest = 1e9;
    double highest = -1e9;
    double floor_low = 1e9;
    double floor_high = -1e9;
    visitDriven(*plan, 0.02, [&](const Vector3d& place) {
        least = std::min(least, leastDistance(scene, place, params));
        lowest = std::min(lowest, place.z());
        highest = std::max(highest, place.z());
        // The floor under the middle and the rim of the body.
        for (int k = 0; k < 9; ++k) {
            const double angle = k * 45.0 * kDegree;
            const double out = k == 8 ? 0.0 : params.body.body_radius_m - 0.01;
            const Vector3d from = place + out * Vector3d(std::cos(angle), std::sin(angle), 0.0);
            const RayHit hit = rays.cast(from, -Vector3d::UnitZ());
            ASSERT_NE(hit.object_id, 0);
            floor_low = std::min(floor_low, from.z() - hit.distance);
            floor_high = std::max(floor_high, from.z() - hit.distance);
        }
    });
    EXPECT_NEAR(lowest, 0.4, 1e-5);
    EXPECT_NEAR(highest, 0.4, 1e-5);
    EXPECT_GT(least, params.body.body_radius_m);
    EXPECT_GE(floor_low, -0.03) << "no step down";
    EXPECT_LE(floor_high, 0.03) << "no step up";
    for (const TrajectoryFrame& frame : plan->trajectory.frames) {
        EXPECT_NEAR(frame.pose.forward().z(), 0.0, 1e-6);
    }
    EXPECT_LE(largestHeadingAngle(*plan), params.body.max_heading_deg + 0.1);
}

// The counterpart of the test above: a free camera does not keep that rule by chance.
TEST(Robot, AFreeCameraLooksAsideWhileItMoves) {
    PlanParams params = robot();
    params.body.heading = Heading::Free;
    const auto plan = robotPlan(roomForARobot(), params);
    EXPECT_GT(largestHeadingAngle(*plan), 60.0);
}

TEST(Robot, KeepsToItsBudgetOfFrames) {
    PlanParams params = robot();
    params.timing.max_frames = 40;
    const auto plan = robotPlan(roomForARobot(), params);
    EXPECT_LE(plan->trajectory.frames.size(), 40U);
    EXPECT_GE(plan->trajectory.frames.size(), 5U);
    EXPECT_LE(largestHeadingAngle(*plan), params.body.max_heading_deg + 0.1);
}

// Storeys that only stairs connect are driven on separately.
TEST(Robot, DrivesOnEachStoreyByItself) {
    test::SceneBuilder builder;
    const test::SceneBuilder::Look floor{kNyuFloor, Role::Structure, {0.6F, 0.6F, 0.6F}};
    builder.room({0, 0, 0}, {5, 3, 5.4});
    builder.object("upper floor", floor).box({3.2, 1.5, 2.7}, {3.6, 3.0, 0.2});
    builder.object("crate").box({4.5, 0.5, 0.25}, {0.5, 0.5, 0.5});
    builder.object("trunk").box({4.5, 2.5, 3.05}, {0.5, 0.5, 0.5});
    const auto plan = robotPlan(builder.build(), robot());
    EXPECT_EQ(plan->capture_metrics.captured, 2);
    ASSERT_EQ(plan->smooth_paths.size(), 2U);
    for (const TrajectoryFrame& frame : plan->trajectory.frames) {
        const double z = frame.pose.position.z();
        EXPECT_LT(std::min(std::abs(z - 0.4), std::abs(z - 3.2)), 1e-5);
    }
}

/// A house whose floor is missing, as in robot simulators, where it stands on the world's ground.
TEST(Robot, DrivesAtTheLowerEndOfTheWallsWhereThereIsNoFloor) {
    test::SceneBuilder builder;
    const test::SceneBuilder::Look wall{kNyuWall, Role::Structure, {0.7F, 0.7F, 0.7F}};
    const test::SceneBuilder::Look sill{kNyuOtherStructure, Role::Structure, {0.7F, 0.7F, 0.7F}};
    builder.object("north", wall).box({3, 4.05, 1.25}, {6, 0.1, 2.5});
    builder.object("south", wall).box({3, -0.05, 1.25}, {6, 0.1, 2.5});
    builder.object("west", wall).box({-0.05, 2, 1.25}, {0.1, 4, 2.5});
    // A wall with a window: its sill is the only level surface below the free space.
    builder.object("east_0", wall).box({6.05, 0.75, 1.25}, {0.1, 1.5, 2.5});
    builder.object("east_1", wall).box({6.05, 3.25, 1.25}, {0.1, 1.5, 2.5});
    builder.object("sill", sill).box({6.1, 2, 0.25}, {0.2, 1.0, 0.5});
    builder.object("chest").box({1.0, 3.6, 0.3}, {0.8, 0.5, 0.6});
    builder.object("plant").box({5.0, 0.5, 0.4}, {0.4, 0.4, 0.8});
    const auto plan = robotPlan(builder.build(), robot());
    ASSERT_GT(plan->trajectory.frames.size(), 10U);
    EXPECT_EQ(plan->capture_metrics.captured, 2);
    for (const TrajectoryFrame& frame : plan->trajectory.frames) {
        ASSERT_NEAR(frame.pose.position.z(), robot().body.camera_height_m, 1e-6);
    }
}

TEST(Robot, ParametersThatDoNotGoTogetherAreRefused) {
    PlanParams params = robot();
    EXPECT_TRUE(validate(params));
    params.body.camera_height_m = 0.0;
    ASSERT_FALSE(validate(params));
    EXPECT_EQ(validate(params).error().where, "body");
    params = robot();
    params.shake.shake = ShakeKind::Handheld;
    ASSERT_FALSE(validate(params));
    EXPECT_EQ(validate(params).error().where, "heading");
    params = robot();
    params.free_space.min_height_m = 1.0;
    ASSERT_FALSE(validate(params));
    EXPECT_EQ(validate(params).error().where, "camera_height_m");
}

TEST(Robot, APresetSetsHeightBodyPitchAndHeading) {
    PlanParams params;
    ASSERT_TRUE(setField(listFields(params), "camera_preset=robot"));
    EXPECT_EQ(params, robot());
    EXPECT_EQ(params.constraints.min_pitch_deg, 0.0);
    EXPECT_EQ(params.constraints.max_pitch_deg, 0.0);
    PlanParams named;  // JSON sorts its names: the other parameters come before the preset there
    ASSERT_TRUE(setFromJson(listFields(named),
                            {{"body", {{"body_radius_m", 0.3}, {"camera_preset", "robot"}}},
                             {"constraints", {{"max_pitch_deg", 5.0}}}}));
    EXPECT_EQ(named.body.body_radius_m, 0.3);
    EXPECT_EQ(named.constraints.max_pitch_deg, 5.0);
    EXPECT_EQ(named.body.heading, Heading::Along);
    ASSERT_TRUE(setField(listFields(params), "camera_preset=free"));
    EXPECT_EQ(params, PlanParams{});
}

}  // namespace
}  // namespace dollytrack::planning::robot_test
