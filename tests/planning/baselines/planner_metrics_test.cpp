#include "planning/baselines/planner_metrics.h"

#include "engine/geometry/ray_caster.h"
#include "planning/baselines/dollytrack_planner.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/pipeline/pipeline.h"
#include "planning/smoothing/smooth_path.h"
#include "planning/timing/motion_limits.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dollytrack::planning::planner_metrics_test {
namespace {

using Eigen::Vector3d;

MappedScene mapped(Scene scene) {
    auto made = mapScene(std::make_shared<const Scene>(std::move(scene)), {}, {}, {});
    EXPECT_TRUE(made.has_value());
    return std::move(*made);
}

test::SceneBuilder roomWithCord() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("cord").box({2.013, 1.5, 2.0}, {0.002, 0.002, 1.2});
    return builder;
}

/// A motion through positions, one second apart, looking along x.
PlannedMotion through(const std::vector<Vector3d>& places) {
    PlannedMotion motion;
    motion.trajectory.frame_interval_s = 1.0;
    for (const Vector3d& place : places) {
        TrajectoryFrame frame;
        frame.time_s = static_cast<double>(motion.trajectory.frames.size());
        frame.pose = lookAt(place, place + Vector3d::UnitX());
        motion.trajectory.frames.push_back(frame);
    }
    return motion;
}

PlannerMetrics measured(const MappedScene& scene, const PlannedMotion& motion) {
    const auto result = measurePlannedMotion(scene, motion, {});
    EXPECT_TRUE(result.has_value());
    return result.value_or(PlannerMetrics{});
}

}  // namespace

// A cord 2 mm thick lies on the path between two frames; neither frame touches it.
TEST(PlannerMetrics, MeetsAThinCordBetweenFrames) {
    const MappedScene scene = mapped(roomWithCord().build());
    const PlannerMetrics result = measured(
        scene, through({{0.5, 1.5, 2.0}, {1.5, 1.5, 2.0}, {2.5, 1.5, 2.0}, {3.4, 1.5, 2.0}}));
    EXPECT_EQ(result.frame_collision_rate, 0.0);
    ASSERT_TRUE(result.move_collision_rate);
    EXPECT_NEAR(*result.move_collision_rate, 1.0 / 3.0, 1e-12);
    EXPECT_LT(result.min_clearance_m, 0.02);
}

// The path that a planner gives is measured, not the straight line.
TEST(PlannerMetrics, FollowsTheWayBetweenFrames) {
    const MappedScene scene = mapped(roomWithCord().build());
    PlannedMotion motion = through({{1.5, 1.5, 2.0}, {2.5, 1.5, 2.0}});
    motion.between = {{{1.5, 0.5, 2.0}, {2.5, 0.5, 2.0}}};
    const PlannerMetrics result = measured(scene, motion);
    EXPECT_EQ(*result.move_collision_rate, 0.0);
    EXPECT_NEAR(*result.path_length_m, 3.0, 1e-12);
    EXPECT_NEAR(*result.speed_max_mps, 3.0, 1e-12);
    // The cord ends at x = 2.014, nearer than the wall y = 0.
    EXPECT_NEAR(result.min_clearance_m, 0.486, 1e-6);
}

// From the smallest coordinate that a file may hold to the largest, through the room: 10^8 steps of
// 2 cm.
TEST(PlannerMetrics, AWayFromVeryFarMeetsTheRoomAndEnds) {
    const MappedScene scene = mapped(roomWithCord().build());
    const PlannerMetrics result =
        measured(scene, through({{-1e6, 1.5, 2.0}, {1e6, 1.5, 2.0}, {1e6, 9e5, 2.0}}));
    ASSERT_TRUE(result.move_collision_rate);
    EXPECT_EQ(*result.move_collision_rate, 0.5);
    EXPECT_EQ(result.frame_collision_rate, 0.0);
    EXPECT_LT(result.min_clearance_m, 0.02);
}

TEST(PlannerMetrics, AFrameInAWallCollidesAndIsOutside) {
    const MappedScene scene = mapped(roomWithCord().build());
    const PlannerMetrics result = measured(
        scene, through({{0.5, 1.5, 1.3}, {0.05, 1.5, 1.3}, {-1.0, 1.5, 1.3}, {0.5, 1.0, 1.3}}));
    EXPECT_EQ(result.frame_collision_rate, 0.25);  // 5 cm from the wall
    EXPECT_GE(result.outside_rate, 0.25);          // a metre behind it
    EXPECT_EQ(*result.move_collision_rate, 1.0);
}

// x = t^3 / 10: the third derivative is 0.6 everywhere, and finite differences of it are exact.
TEST(PlannerMetrics, JerkIsTheThirdDerivative) {
    const MappedScene scene = mapped(roomWithCord().build());
    std::vector<Vector3d> places;
    for (int t = 0; t < 4; ++t) places.emplace_back(0.3 + 0.1 * t * t * t, 0.5, 1.0);
    const PlannerMetrics result = measured(scene, through(places));
    EXPECT_NEAR(*result.jerk_median_mps3, 0.6, 1e-9);
    EXPECT_NEAR(*result.jerk_max_mps3, 0.6, 1e-9);
    EXPECT_NEAR(*result.speed_median_mps, 0.7, 1e-9);
    EXPECT_NEAR(*result.speed_max_mps, 1.9, 1e-9);
    EXPECT_NEAR(*result.turn_max_dps, 0.0, 1e-9);
}

TEST(PlannerMetrics, TurnsAreInDegreesASecond) {
    const MappedScene scene = mapped(roomWithCord().build());
    PlannedMotion motion = through({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
    auto& frames = motion.trajectory.frames;
    frames[1].pose = lookAt({1, 1, 1}, {2, 2, 1});
    frames[1].time_s = 0.5;
    frames[2].pose = lookAt({1, 1, 1}, {1, 2, 1});
    frames[2].time_s = 1.5;
    const PlannerMetrics result = measured(scene, motion);
    EXPECT_NEAR(*result.turn_max_dps, 90.0, 1e-9);
    EXPECT_NEAR(*result.turn_median_dps, 67.5, 1e-9);
}

// Frames without a motion between them have no speed, no length and no collisions in between.
TEST(PlannerMetrics, ViewsWithoutMotionHaveNoMotionMetrics) {
    const MappedScene scene = mapped(roomWithCord().build());
    PlannedMotion motion = through({{1.5, 1.5, 2.0}, {2.5, 1.5, 2.0}});
    motion.trajectory.frames[1].path = 1;
    const PlannerMetrics result = measured(scene, motion);
    EXPECT_FALSE(result.path_length_m || result.speed_max_mps || result.move_collision_rate ||
                 result.turn_max_dps || result.jerk_max_mps3);
}

TEST(PlannerMetrics, AnEmptyFlightCapturesNothing) {
    const MappedScene scene = mapped(test::furnishedRoom());
    const PlannerMetrics result = measured(scene, {});
    EXPECT_EQ(result.frames, 0);
    EXPECT_EQ(result.captures.capture_rate, 0.0);
    EXPECT_GT(result.captures.objects, 0);
}

// The poses alone give the same numbers that `plan` gives for its own trajectory.
TEST(PlannerMetrics, AgreesWithThePipeline) {
    PlanParams params;
    params.timing.max_frames = 120;
    params.gaze.trackability = Trackability::On;
    const auto scene = std::make_shared<const Scene>(test::furnishedRoom());
    Pipeline pipeline(scene);
    const auto plan = pipeline.run(params, JobContext{});
    ASSERT_TRUE(plan);
    const MappedScene map = mapped(*scene);
    const PlannerMetrics result = measured(map, plannedMotionOf(**plan));
    const CaptureMetrics& captures = (*plan)->capture_metrics;
    const TrajectoryMetrics& motion = (*plan)->trajectory_metrics;
    EXPECT_EQ(result.captures.captured, captures.captured);
    EXPECT_EQ(result.captures.well_captured, captures.well_captured);
    EXPECT_EQ(result.captures.area_share_box, captures.area_share_box);
    EXPECT_EQ(result.repeat_rate, motion.repeat_rate);
    EXPECT_EQ(result.object_pixels, motion.object_pixels);
    EXPECT_EQ(result.trackable_rate, motion.trackable_rate);
    EXPECT_EQ(*result.corner_collision_rate, motion.corner_collision_rate);
    EXPECT_EQ(*result.move_collision_rate, 0.0);
    EXPECT_EQ(result.outside_rate, 0.0);
    // The measurement takes chords of at most a centimetre instead of the curves, and only from the
    // first to the last key frame.
    EXPECT_NEAR(*result.path_length_m, motion.path_length_m, 1e-3 * motion.path_length_m);
    EXPECT_LE(*result.speed_max_mps, motionLimits(params.timing).speed_mps + 1e-6);
    EXPECT_LE(*result.turn_max_dps,
              motionLimits(params.timing).turn_rps * 180.0 / std::numbers::pi + 0.5);
}

// A pillar in the inner corner of a right-angled turn: the curve with the full set-back cuts it,
// and the blind smoothing takes that curve.
TEST(BlindSmoothing, CutsTheCornerAndIsCounted) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 4, 2.6});
    builder.object("pillar").box({2.2, 1.8, 1.3}, {0.1, 0.1, 2.6});
    const MappedScene scene = mapped(builder.build());
    const PlanningEnvironment environment{*scene.views, *scene.free_space, *scene.sphere};
    CameraPath path;
    for (const Vector3d& place :
         {Vector3d(2.5, 3.5, 1.2), Vector3d(2.5, 1.5, 1.2), Vector3d(0.5, 1.5, 1.2)}) {
        path.vertices.push_back({place, -1});
    }
    const SmoothPath wide = smoothBlindly(path, 1.0, environment);
    ASSERT_EQ(wide.pieces.size(), 3U);
    EXPECT_NEAR((wide.pieces[1].start - Vector3d(2.5, 2.5, 1.2)).norm(), 0.0, 1e-12);
    EXPECT_EQ(wide.corner_collisions, 1);
    EXPECT_EQ(smoothBlindly(path, 0.1, environment).corner_collisions, 0);
    // A set-back longer than half a leg is clipped to half the leg.
    EXPECT_NEAR(smoothBlindly(path, 5.0, environment).corners.front().set_back_m, 1.0, 1e-12);
    const auto ours = smoothPath(path, {}, {}, environment,
                                 SmoothingParams{.corner_distance_m = 1.0}, JobContext{});
    ASSERT_TRUE(ours);
    EXPECT_EQ(ours->corner_collisions, 0);
    EXPECT_GT(ours->corners.front().set_back_m, 0.0);
}

TEST(MetricsRow, MediansAndMeansSkipWhatDoesNotApply) {
    const std::size_t columns = plannerMetricInfos().size();
    std::vector<MetricsRow> rows(3, MetricsRow(columns));
    rows[0][0] = 1.0;
    rows[1][0] = 5.0;
    rows[2][0] = 3.0;
    rows[1][1] = 4.0;
    rows[2][1] = 8.0;
    EXPECT_EQ(*medianOf(rows)[0], 3.0);
    EXPECT_EQ(*medianOf(rows)[1], 6.0);
    EXPECT_EQ(*meanOf(rows)[0], 3.0);
    EXPECT_EQ(*meanOf(rows)[1], 6.0);
    EXPECT_FALSE(meanOf(rows)[2]);
}

}  // namespace dollytrack::planning::planner_metrics_test
