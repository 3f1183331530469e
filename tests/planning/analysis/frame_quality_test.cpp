#include "planning/analysis/frame_quality.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/pipeline/pipeline.h"
#include "planning/pipeline/search_environment.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"
#include "tests/planning/support/plan_support.h"
#include "tests/planning/support/rising_progress.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

namespace dollytrack::planning::frame_quality_test {
namespace {

/// A hall whose wall at x = 20 fills 4 x 3 m of the image from 4 m away. Rays are 0.25 m apart
/// there, and none is nearer than 0.125 m to the edge of the image.
struct Hall {
    explicit Hall(const std::function<void(test::SceneBuilder&)>& furnish = {})
        : scene([&] {
              test::SceneBuilder builder;
              builder.room({0, 0, 0}, {20, 20, 20});
              if (furnish) furnish(builder);
              return builder.build();
          }()) {}

    static CameraParams camera() {
        CameraParams params;
        params.width_px = 640;
        params.height_px = 480;
        params.hfov_deg = 2.0 * std::atan(0.5) * 180.0 / std::numbers::pi;
        return params;
    }

    Scene scene;
    RayCaster rays{scene};
    ViewEstimator views{scene, rays, camera()};
};

const Pose kFacing = {{16, 10, 10}, lookAlong({1, 0, 0})};

Pose shifted(const Eigen::Vector3d& by) {
    return {kFacing.position + by, kFacing.rotation};
}

TrajectoryFrame frameAt(const Pose& pose, int path = 0) {
    TrajectoryFrame frame;
    frame.pose = pose;
    frame.path = path;
    return frame;
}

}  // namespace

TEST(ImageOverlap, IsTheShareOfTheWallThatBothImagesShow) {
    const Hall hall;
    EXPECT_EQ(imageOverlap(hall.views, kFacing, kFacing), 1.0);
    EXPECT_EQ(imageOverlap(hall.views, shifted({0, 1.0, 0}), kFacing), 12.0 / 16.0);
    EXPECT_EQ(imageOverlap(hall.views, shifted({0, 0, -0.75}), kFacing), 9.0 / 12.0);
    EXPECT_EQ(imageOverlap(hall.views, shifted({0, 1.0, 0.75}), kFacing), 0.75 * 0.75);
    EXPECT_EQ(imageOverlap(hall.views, shifted({0, 4.5, 0}), kFacing), 0.0);
    // Half as far away, the image shows the middle quarter of what it showed before.
    EXPECT_EQ(imageOverlap(hall.views, shifted({2, 0, 0}), kFacing), 1.0);
    EXPECT_EQ(imageOverlap(hall.views, kFacing, shifted({2, 0, 0})), 0.25);
    const Pose aside = {kFacing.position, lookAlong({0, 1, 0})};
    EXPECT_EQ(imageOverlap(hall.views, aside, kFacing), 0.0);
}

TEST(ImageOverlap, LeavesOutWhatWasHiddenBefore) {
    // A board between the two positions hides the half of the wall with larger y.
    const Hall hall([](test::SceneBuilder& builder) {
        builder.object("board").box({16.5, 12.5, 10}, {0.02, 5.0, 5.0});
    });
    EXPECT_EQ(imageOverlap(hall.views, shifted({2, 0, 0}), kFacing), 0.5);
    EXPECT_EQ(imageOverlap(hall.views, kFacing, kFacing), 1.0);
}

TEST(FrameQuality, IsMeasuredForPlansOfAnyObjectiveAndWithinPaths) {
    const Scene scene = test::furnishedRoom();
    PlanParams params;
    params.timing.max_frames = 40;
    params.coverage.objective = Objective::Both;
    params.gaze.trackability = Trackability::On;
    const auto both = test_support::planOf(scene, params);
    ASSERT_TRUE(both->surface);
    ASSERT_FALSE(both->series.image_corners.empty());

    const RayCaster rays(scene);
    const FreeSpace map = *FreeSpace::build(scene, rays, params.camera, params.free_space);
    const SweptSphere sphere(rays, map, params.camera.camera_radius_m);
    const ViewEstimator views(scene, rays, params.camera);
    const PlanningEnvironment environment{views, map, sphere, pitchBand(params.constraints)};
    // Without what the plan has measured itself, the same numbers are found.
    Plan plan = *both;
    plan.surface.reset();
    plan.series.image_corners.clear();
    const auto quality = measureFrameQuality(environment, params, plan, JobContext{});
    ASSERT_TRUE(quality);
    EXPECT_EQ(quality->image_corners, both->series.image_corners);
    EXPECT_EQ(quality->surface.patches, both->surface->patches);
    EXPECT_EQ(quality->surface.seen, both->surface->seen);
    EXPECT_EQ(quality->surface.covered, both->surface->covered);
    // So they are with the maps of a pipeline that is gone.
    const auto search = [&] {
        const auto shared = std::make_shared<const Scene>(scene);
        Pipeline pipeline(shared);
        EXPECT_TRUE(pipeline.run(params, JobContext{}));
        return std::make_unique<SearchEnvironment>(mapsOf(pipeline, shared), params);
    }();
    test_support::RisingProgress progress;
    const auto again = measureFrameQuality(search->environment(), params, plan, progress.job());
    ASSERT_TRUE(again);
    EXPECT_EQ(again->image_corners, quality->image_corners);
    EXPECT_EQ(again->overlap, quality->overlap);
    EXPECT_EQ(again->surface.covered, quality->surface.covered);
    const auto& frames = plan.trajectory.frames;
    ASSERT_EQ(quality->overlap.size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const bool begins = i == 0 || frames[i].path != frames[i - 1].path;
        EXPECT_EQ(quality->overlap[i],
                  begins ? 1.0 : imageOverlap(views, frames[i].pose, frames[i - 1].pose));
    }
    const auto cancel = std::make_shared<const std::atomic<bool>>(true);
    const auto stopped = measureFrameQuality(environment, params, plan, JobContext(cancel, {}));
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
}

TEST(FrameQuality, SummaryCountsGapsWithinPathsOnly) {
    Trajectory trajectory;
    for (const int path : {0, 0, 0, 1, 1}) trajectory.frames.push_back(frameAt(kFacing, path));
    FrameQuality quality;
    quality.image_corners = {0.0, 149.9, 150.0, 400.0, 20.0};
    quality.overlap = {1.0, 0.9, 0.599, 0.0, 0.6};  // the fourth begins a path
    const FrameQualitySummary summary = summarize(trajectory, quality);
    EXPECT_EQ(summary.untrackable, 3);
    EXPECT_DOUBLE_EQ(*summary.trackable_rate, 0.4);
    EXPECT_EQ(summary.wide_gaps, 1);
    EXPECT_EQ(summary.overlap_min_rate, 0.599);
    EXPECT_EQ(summary.overlap_median_rate, 0.6);

    nlohmann::json metrics;
    addFrameQuality(metrics, trajectory, quality);
    EXPECT_EQ(metrics["untrackable_frames"], 3);
    EXPECT_EQ(metrics["wide_gaps"], 1);
    EXPECT_EQ(metrics["overlap_min_rate"], 0.599);
    addFrameQuality(metrics, {}, {});
    EXPECT_TRUE(metrics["overlap_min_rate"].is_null());
    EXPECT_TRUE(metrics["trackable_rate"].is_null());
}

TEST(FrameQuality, TableHasARowPerFrame) {
    Trajectory trajectory;
    trajectory.frame_interval_s = 0.5;
    for (int i = 0; i < 3; ++i) {
        trajectory.frames.push_back(frameAt(kFacing, i == 2 ? 1 : 0));
        trajectory.frames.back().time_s = 0.5 * i;
    }
    trajectory.frames[1].position_point = 4;
    FrameSeries series;
    series.clearance_m = {0.25, 0.5, 1.0};
    series.speed_mps = {0.0, 0.125, 0.0};
    series.turn_dps = {0.0, 30.0, 0.0};
    series.score = {0.5, 0.75, 1.0};
    series.in_view = {1, 2, 3};
    series.captured = {1, 1, 2};
    series.well_captured = {0, 1, 0};
    series.newly_captured = {{7}, {}, {8, 9}};
    FrameQuality quality;
    quality.image_corners = {100.5, 200.0, 300.0};
    quality.overlap = {1.0, 0.875, 1.0};
    EXPECT_EQ(frameTable(trajectory, series, quality),
              "frame,time_s,path,key_frame,clearance_m,speed_mps,turn_dps,in_view,captured,"
              "well_captured,newly_captured,score,image_corners,overlap\n"
              "0,0,0,0,0.25,,,1,1,0,1,0.5,100.5,\n"
              "1,0.5,0,1,0.5,0.125,30,2,1,1,0,0.75,200,0.875\n"
              "2,1,1,0,1,,,3,2,0,2,1,300,\n");
}

}  // namespace dollytrack::planning::frame_quality_test
