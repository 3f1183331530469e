#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/gaze/context_views.h"
#include "planning/gaze/corner_panorama.h"
#include "planning/gaze/image_motion.h"
#include "planning/gaze/panorama.h"
#include "planning/timing/turn.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/pitch_band.h"
#include "planning/visibility/view_estimator.h"
#include "tests/planning/support/map_support.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace dollytrack::planning::gaze_test {
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

/// A hall with four plain objects along a bare wall, and shelves full of small things opposite.
Scene hallWithShelves() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {9, 5, 2.6});
    for (int i = 0; i < 4; ++i) {
        builder.object("box " + std::to_string(i)).box({1.0 + 2.3 * i, 4.7, 0.3}, {0.4, 0.4, 0.6});
    }
    for (int row = 0; row < 4; ++row) {
        for (int i = 0; i < 24; ++i) {
            test::SceneBuilder::Look look{kNyuWall, Role::Structure, {0.1F, 0.05F, 0.1F}};
            if (i % 2 == 0) look.color = {0.9F, 0.9F, 0.8F};
            builder.object("thing", look)
                .box({0.5 + 0.35 * i, 0.15, 0.4 + 0.5 * row}, {0.2, 0.3, 0.3});
        }
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
    PlanParams params = withContext(0.0);
    params.path.max_length_m = 1000.0;  // no room views
    const auto close = planOf(scene, params);
    params.gaze.view_mix = 0.7;
    const auto mixed = planOf(scene, params);
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

TEST(ContextViews, PathsOfTwoRoomsShareTheBudget) {
    test::SceneBuilder builder;
    for (const double x : {0.0, 10.0}) {
        builder.room({x, 0, 0}, {x + 9.0, 5, 2.6});
        for (int i = 0; i < 8; ++i) {
            const std::string name = std::to_string(static_cast<int>(x) + i);
            builder.object("south " + name).box({x + 0.9 + i, 0.3, 0.3}, {0.3, 0.3, 0.6});
            builder.object("north " + name).box({x + 1.3 + i, 4.7, 0.4}, {0.4, 0.3, 0.8});
        }
    }
    const Scene scene = builder.build();
    for (const int max_frames : {3, 20, 30, 40, 60, 80}) {
        PlanParams params;  // with room views and context views
        params.timing.max_frames = max_frames;
        const auto plan = planOf(scene, params);
        EXPECT_EQ(plan->smooth_paths.size(), max_frames < 20 ? 1U : 2U) << max_frames;
        EXPECT_LE(plan->trajectory.frames.size(), static_cast<std::size_t>(max_frames));
        EXPECT_GT(plan->trajectory.frames.size(), 0U);
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

TEST(Trackability, LooksLessAtBareWalls) {
    const Scene scene = hallWithShelves();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, CameraParams{});
    CornerPanoramas corners(views);
    PlanParams params;
    params.viewpoints.fill = kFillForTrackability;  // the same close views in both
    params.timing.motion_preset = MotionPreset::Easy;
    const auto shareWithFewCorners = [&](Trackability trackability) {
        params.gaze.trackability = trackability;
        const auto plan = planOf(scene, params);
        EXPECT_EQ(plan->trajectory_metrics.frame_collision_rate, 0.0);
        double few = 0.0;
        for (const TrajectoryFrame& frame : plan->trajectory.frames) {
            few += corners.at(frame.pose.position)->corners(frame.pose.forward()) < 200.0;
        }
        return few / static_cast<double>(plan->trajectory.frames.size());
    };
    const double off = shareWithFewCorners(Trackability::Auto);
    EXPECT_GT(off, 0.2);
    EXPECT_LT(shareWithFewCorners(Trackability::On), 0.75 * off);
}

// Two key frames that face the ends of the hall: the shorter turn passes the bare wall.
TEST(Trackability, TurnsPastTheShelvesOnTheSpot) {
    const Scene scene = hallWithShelves();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, CameraParams{});
    const FreeSpace free_space = test_support::map(scene);
    const SweptSphere sphere(rays, free_space, 0.1);
    CornerPanoramas corners(views);
    PlanningEnvironment environment{views, free_space, sphere};
    const Eigen::Vector3d from(4.5, 2.0, 1.3), to(4.55, 2.0, 1.3);
    SmoothPath path;
    path.append(from, 0.5 * (from + to), to, false);
    path.length_m = 0.05;
    path.keys = {{0.0, 0, from}, {0.05, 1, to}};
    const auto pose_at = [](const SmoothPath::Key& key) -> Pose {
        const double azimuth = (key.position_point == 0 ? 170.0 : 10.0) * std::numbers::pi / 180.0;
        return {key.position, lookAlong({std::cos(azimuth), std::sin(azimuth), 0.0})};
    };
    const GazeParams gaze{0.1, Trackability::On};
    EXPECT_EQ(withContextViews(path, pose_at, environment, gaze, {}).keys.size(), 2U);
    environment.corners = &corners;
    const SmoothPath turned = withContextViews(path, pose_at, environment, gaze, {});
    ASSERT_GT(turned.keys.size(), 2U);
    for (const SmoothPath::Key& key : turned.keys) {
        if (key.position_point >= 0) continue;
        EXPECT_LT(key.looks_at.y(), key.position.y());
    }
}

TEST(SlamPreset, KeepsTheFrameRateAndTheTurningLimit) {
    const Scene scene = hallWithShelves();
    PlanParams params;
    params.timing.motion_preset = MotionPreset::Slam;
    params.timing.max_frames = 250;
    const auto plan = planOf(scene, params);
    const auto& frames = plan->trajectory.frames;
    EXPECT_LE(frames.size(), 250U);
    EXPECT_GT(frames.size(), 100U);
    EXPECT_DOUBLE_EQ(plan->trajectory.frame_interval_s, 0.1);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        // 40 degrees per second at 10 frames per second.
        EXPECT_LE(angleBetween(frames[i - 1].pose.rotation, frames[i].pose.rotation),
                  4.01 * std::numbers::pi / 180.0);
    }
    PlanParams same = params;
    same.viewpoints.fill = kFillForTrackability;
    const auto again = planOf(scene, same);
    EXPECT_EQ(again->trajectory.frames.size(), frames.size());
    EXPECT_EQ(keyFramePoses(*again), keyFramePoses(*plan));
}

// A small shelf on the bare wall opposite is near, but the turn to it sweeps across bare walls.
TEST(SlamPreset, LeavesOutObjectsAmongBareViews) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {12, 3, 2.6});
    const auto addShelf = [&](double from_x, int columns, double y) {
        for (int row = 0; row < 5; ++row) {
            for (int i = 0; i < columns; ++i) {
                test::SceneBuilder::Look look{kNyuWall, Role::Structure, {0.1F, 0.05F, 0.1F}};
                if ((i + row) % 2 == 0) look.color = {0.9F, 0.9F, 0.8F};
                builder.object("thing", look)
                    .box({from_x + 0.25 * i, y, 0.4 + 0.3 * row}, {0.2, 0.1, 0.2});
            }
        }
    };
    addShelf(0.5, 45, 0.05);
    for (int i = 0; i < 6; ++i) {
        builder.object("cup " + std::to_string(i)).box({1.0 + 2.0 * i, 0.2, 1.0}, {0.2, 0.2, 0.3});
    }
    addShelf(4.5, 5, 2.95);
    builder.object("cup opposite").box({5.0, 2.8, 1.0}, {0.2, 0.2, 0.3});
    const Scene scene = builder.build();
    PlanParams params;
    params.timing.motion_preset = MotionPreset::Slam;
    params.timing.max_frames = 180;
    params.gaze.view_mix = 0.0;
    const auto plan = planOf(scene, params);
    EXPECT_EQ(plan->trajectory_metrics.trackable_rate, 1.0);
    EXPECT_FALSE(plan->captures.back().captured);  // the cup opposite
    EXPECT_GE(plan->capture_metrics.captured, 4);
    params.gaze.trackability = Trackability::Off;
    params.viewpoints.fill = kFillForTrackability;
    EXPECT_TRUE(planOf(scene, params)->captures.back().captured);
}

TEST(SlamPreset, BeginsWithAViewOfManyCorners) {
    const Scene scene = hallWithShelves();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, CameraParams{});
    CornerPanoramas corners(views);
    PlanParams params;
    params.timing.motion_preset = MotionPreset::Slam;
    const auto plan = planOf(scene, params);
    const Pose& first = plan->trajectory.frames.front().pose;
    EXPECT_GT(corners.at(first.position)->corners(first.forward()), 350.0);
}

TEST(Trackability, ReplansLikeAFreshPipeline) {
    const auto scene = std::make_shared<const Scene>(hallWithShelves());
    PlanParams params;
    params.viewpoints.fill = kFillForTrackability;
    params.timing.keep_frame_rate = true;
    params.timing.max_frames = 200;
    Pipeline pipeline(scene);
    const auto without = pipeline.run(params, JobContext{});
    ASSERT_TRUE(without);
    EXPECT_TRUE((*without)->series.image_corners.empty());
    EXPECT_FALSE((*without)->trajectory_metrics.trackable_rate);
    params.gaze.trackability = Trackability::On;
    const auto changed = pipeline.run(params, JobContext{});
    ASSERT_TRUE(changed);
    const auto fresh = planOf(*scene, params);
    EXPECT_EQ((*changed)->series.image_corners, fresh->series.image_corners);
    EXPECT_EQ(fresh->series.image_corners.size(), fresh->trajectory.frames.size());
    EXPECT_EQ((*changed)->trajectory_metrics.trackable_rate,
              fresh->trajectory_metrics.trackable_rate);
    EXPECT_TRUE(fresh->trajectory_metrics.trackable_rate);
    params.gaze.trackability = Trackability::Off;
    const auto off = pipeline.run(params, JobContext{});
    ASSERT_TRUE(off);
    EXPECT_TRUE((*off)->series.image_corners.empty());
    EXPECT_LE(fresh->trajectory.frames.size(), 200U);
    ASSERT_EQ((*changed)->trajectory.frames.size(), fresh->trajectory.frames.size());
    for (std::size_t i = 0; i < fresh->trajectory.frames.size(); ++i) {
        EXPECT_EQ((*changed)->trajectory.frames[i].pose, fresh->trajectory.frames[i].pose);
    }
}

TEST(RoomViews, ShowManyObjectsFromEyeLevelBesideTheCloseViews) {
    const Scene scene = furnishedHall();
    const auto close = planOf(scene, withContext(0.0));
    const auto mixed = planOf(scene, withContext(0.9));
    std::map<int, std::size_t> targets;  // by frame
    for (std::size_t i = 0; i < mixed->frame_views.size(); ++i) {
        const int point = mixed->trajectory.frames[i].position_point;
        if (point >= 0) targets[point] = mixed->frame_views[i].size();
    }
    double at_close = 0.0, at_room = 0.0;
    int close_views = 0, room_views = 0;
    for (const auto& [index, count] : targets) {
        const PositionPoint& point = mixed->position_points[index];
        (point.room_view ? at_room : at_close) += static_cast<double>(count);
        ++(point.room_view ? room_views : close_views);
        if (!point.room_view) continue;
        EXPECT_GT(point.pose.position.z(), 0.7);
        EXPECT_LT(point.pose.position.z(), 2.2);
    }
    EXPECT_EQ(close_views, static_cast<int>(close->key_frames.size()));
    ASSERT_GT(room_views, 3);
    EXPECT_GT(at_room / room_views, 1.75 * at_close / close_views);
    // Objects that are captured well without room views are captured well with them, too.
    EXPECT_GE(mixed->capture_metrics.well_captured, close->capture_metrics.well_captured);
    EXPECT_EQ(mixed->trajectory_metrics.frame_collision_rate, 0.0);
}

TEST(RoomViews, AreTheFirstToGoUnderABudgetOfFrames) {
    const Scene scene = furnishedHall();
    const auto close = planOf(scene, withContext(0.0));
    const auto roomViewsWithin = [&](int max_frames) {
        PlanParams params = withContext(0.9);
        params.timing.max_frames = max_frames;
        const auto plan = planOf(scene, params);
        EXPECT_LE(plan->trajectory.frames.size(), static_cast<std::size_t>(max_frames));
        EXPECT_EQ(plan->capture_metrics.well_captured, close->capture_metrics.well_captured);
        return std::ranges::count_if(plan->key_frames,
                                     [&](int key) { return plan->position_points[key].room_view; });
    };
    const auto keys = static_cast<int>(close->key_frames.size());
    EXPECT_EQ(roomViewsWithin(keys + 2), 0);
    EXPECT_GT(roomViewsWithin(10 * keys), roomViewsWithin(4 * keys));
}

TEST(RoomViews, AreTheSameWithoutABudgetAndWithOneThatLeavesOutNoFrame) {
    const Scene scene = furnishedHall();
    const auto unlimited = planOf(scene, withContext(0.9));
    const std::size_t frames = unlimited->trajectory.frames.size();
    for (const std::size_t max_frames : {frames, frames + 1, 2 * frames, 20 * frames}) {
        PlanParams params = withContext(0.9);
        params.timing.max_frames = static_cast<int>(max_frames);
        const auto plan = planOf(scene, params);
        ASSERT_EQ(plan->trajectory.frames.size(), frames) << max_frames;
        for (std::size_t i = 0; i < frames; ++i) {
            EXPECT_EQ(plan->trajectory.frames[i].time_s, unlimited->trajectory.frames[i].time_s);
            EXPECT_EQ(plan->trajectory.frames[i].pose.position,
                      unlimited->trajectory.frames[i].pose.position);
        }
    }
}

TEST(RoomViews, SeeNoObjectThroughAWall) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {8, 4, 2.6});
    builder.object("wall", {kNyuWall, Role::Structure}).box({4, 2, 1.3}, {0.1, 4, 2.6});
    builder.object("left").box({0.5, 2, 0.4}, {0.6, 0.6, 0.8});
    for (int i = 0; i < 6; ++i) {
        builder.object("right " + std::to_string(i))
            .box({7.5, 0.5 + 0.6 * i, 0.3}, {0.4, 0.3, 0.6});
    }
    const auto plan = planOf(builder.build(), withContext(0.9));
    for (const PositionPoint& point : plan->position_points) {
        if (!point.room_view || point.pose.position.x() > 4.0) continue;
        // In the left room the objects of the right room must not attract the camera.
        EXPECT_LT(
            angleBetween(point.pose.forward(), Eigen::Vector3d(0.5, 2, 0.4) - point.pose.position),
            0.7);
    }
}

TEST(Panorama, BoundsDirectionsWithoutLosingASighting) {
    const Scene scene = furnishedHall();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, CameraParams{});
    const TargetSamples samples(views);
    const Eigen::Vector3d place(4.5, 2.5, 1.4);
    const Panorama panorama(views, samples, place);
    const Intrinsics& lens = views.intrinsics();
    for (int h = 0; h < 72; ++h) {
        const double heading = 2.0 * 3.14159265 * h / 72;
        const Eigen::Vector3d direction =
            Eigen::Vector3d(std::cos(heading), std::sin(heading), -0.3).normalized();
        const Pose pose{place, lookAlong(direction)};
        std::set<std::size_t> shown;
        panorama.visitShown(direction, [&](std::size_t target, double) { shown.insert(target); });
        for (std::size_t t = 0; t < samples.targets().size(); ++t) {
            const int id = samples.targets()[t].object_id;
            int inside = 0;
            int seen = 0;
            for (const Eigen::Vector3d& point : samples.targets()[t].points) {
                const Eigen::Vector3d p = pose.toCamera(point);
                const Eigen::Vector2d px = lens.project(p);
                if (p.z() <= 0.0 || px.x() <= 0.0 || px.y() <= 0.0 || px.x() >= lens.width ||
                    px.y() >= lens.height) {
                    continue;
                }
                ++inside;
                seen += rays.cast(place, (point - place).normalized()).object_id == id ? 1 : 0;
            }
            if (inside == 0) {
                EXPECT_FALSE(shown.contains(t)) << h << ' ' << t;
            } else if (2 * seen >= TargetSamples::kPerObject) {
                EXPECT_TRUE(shown.contains(t)) << h << ' ' << t;
            }
        }
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
    EXPECT_NEAR(path.keys[1].image_motion_rad, 0.5 * 3.14159265, 1e-3);  // turning on the spot
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

}  // namespace dollytrack::planning::gaze_test
