#include "planning/coverage/surface_views.h"

#include "engine/camera/intrinsics.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/coverage/reachable_patches.h"
#include "planning/coverage/surface_progress.h"
#include "planning/free_space/free_space.h"
#include "planning/visibility/view_estimator.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning::surface_views_test {
namespace {

using test_support::planOf;

constexpr double kRadian = std::numbers::pi / 180.0;

Scene boxRoom() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.5});
    return builder.build();
}

PlanParams forSurface(Objective objective, int max_frames = 300) {
    PlanParams params;
    params.coverage.objective = objective;
    params.timing.max_frames = max_frames;
    return params;
}

/// The surface goal of a scene and a camera, made outside of a plan.
struct Goal {
    Goal(Scene made, const PlanParams& with)
        : scene(std::move(made)),
          rays(scene),
          map(*FreeSpace::build(scene, rays, with.camera, with.free_space)),
          sphere(rays, map, with.camera.camera_radius_m),
          views(scene, rays, with.camera),
          found(*findSurfaceViews({views, map, sphere}, with, {}, 0, JobContext{})) {}

    Scene scene;
    RayCaster rays;
    FreeSpace map;
    SweptSphere sphere;
    ViewEstimator views;
    SurfaceViews found;
};

/// Shares of patches that frames show, counted one by one: every frame, every patch, a ray of its
/// own from the patch to the camera.
struct Counted {
    int seen = 0;
    int covered = 0;
};

Counted countByHand(const Goal& goal, const Trajectory& trajectory, const PlanParams& params) {
    const Intrinsics k = makeIntrinsics(params.camera);
    Counted counted;
    for (const SurfacePatch& patch : goal.found.goal.surface.patches) {
        bool seen = false;
        std::vector<Eigen::Vector3d> directions;
        for (const TrajectoryFrame& frame : trajectory.frames) {
            const Eigen::Vector3d p = frame.pose.worldFromCamera().inverse() * patch.point;
            const double x = k.cx + k.fx * p.x() / p.z();
            const double y = k.cy + k.fy * p.y() / p.z();
            if (p.z() < goal.views.nearDistance() || x < 0 || y < 0 || x >= k.width ||
                y >= k.height) {
                continue;
            }
            const Eigen::Vector3d back = (frame.pose.position - patch.point).normalized();
            if (std::acos(back.dot(patch.normal)) > 75.0 * kRadian) continue;
            const RayHit hit = goal.rays.cast(patch.point, back, p.norm(), 0.0101);
            if (hit.object_id != 0) continue;
            seen = true;
            const bool sharp = 1000.0 * p.norm() / k.fx <= params.coverage.surface_mm_px;
            const bool apart = std::ranges::none_of(directions, [&](const Eigen::Vector3d& other) {
                return std::acos(std::min(1.0, other.dot(back))) < 15.0 * kRadian;
            });
            if (sharp && apart) directions.push_back(back);
        }
        counted.seen += seen ? 1 : 0;
        counted.covered +=
            static_cast<int>(directions.size()) >= params.coverage.surface_directions ? 1 : 0;
    }
    return counted;
}

}  // namespace

// 4 x 3 x 2.5 m: 59 m2 seen from inside, and nothing else.
TEST(ReachablePatches, CoverABoxRoomOnceFromTheInside) {
    const Goal goal(boxRoom(), {});
    const std::vector<Eigen::Vector3d> places = evenPlaces(goal.map, goal.sphere, 100);
    EXPECT_GE(places.size(), 50U);
    EXPECT_LE(places.size(), 200U);
    const auto patches =
        reachablePatches(goal.scene, goal.rays, places, 20'000, 0.25, JobContext{});
    ASSERT_TRUE(patches);
    int count = 0;  // cells of the shifted grid that the six walls pass through
    for (const auto& [width, height] : {std::pair{4.0, 3.0}, {4.0, 2.5}, {3.0, 2.5}}) {
        count += 2 * static_cast<int>((width / 0.25 + 1) * (height / 0.25 + 1));
    }
    EXPECT_EQ(patches->size(), static_cast<std::size_t>(count));
    const Eigen::Vector3d middle(2, 1.5, 1.25);
    for (const SurfacePatch& patch : *patches) {
        const Eigen::Vector3d off =
            (patch.point - middle).cwiseAbs() - Eigen::Vector3d(2, 1.5, 1.25);
        EXPECT_NEAR(off.maxCoeff(), 0.0, 1e-5);
        EXPECT_GT(patch.normal.dot(middle - patch.point), 0.0);
    }
    const auto coarse = thinnedOut(*patches, 1.0);
    EXPECT_LT(coarse.size(), 6U * 20U);
    EXPECT_GE(coarse.size(), 59U);
}

TEST(DistinctDirections, CountOnlyWhatIsFifteenDegreesApart) {
    const auto at = [](double degrees) {
        return Eigen::Vector3d(std::cos(degrees * kRadian), std::sin(degrees * kRadian), 0.0);
    };
    DistinctDirections seen;
    for (const double degrees : {0.0, 14.9, 15.1, -14.9, 30.0, 30.3, 90.0}) {
        seen.add(at(degrees), 8);
    }
    EXPECT_EQ(seen.count(), 4);  // 0, 15.1, 30.3 and 90
    DistinctDirections two;
    for (const double degrees : {0.0, 40.0, 80.0}) two.add(at(degrees), 2);
    EXPECT_EQ(two.count(), 2);
    EXPECT_FALSE(two.adds(at(80.0), 2));
    EXPECT_TRUE(two.adds(at(80.0), 3));
}

TEST(SurfaceProgress, GainsFallAndReachWhatIsPossible) {
    SurfaceProgress progress({2, 0});
    const PatchObservation front{0, true, {1, 0, 0}};
    const PatchObservation side{0, true, {0, 1, 0}};
    const PatchObservation far{1, false, {1, 0, 0}};
    EXPECT_DOUBLE_EQ(progress.gain(front), 2.0);
    progress.add(front);
    EXPECT_DOUBLE_EQ(progress.gain(front), 0.0);
    EXPECT_DOUBLE_EQ(progress.gain(side), 0.5);
    EXPECT_DOUBLE_EQ(progress.gain(far), 1.0);
    progress.add(side);
    EXPECT_FALSE(progress.reaches(0.99));
    EXPECT_TRUE(progress.reaches(0.5));
    progress.add(far);
    EXPECT_TRUE(progress.reaches(1.0));
}

// An empty room: nothing hides anything, so every part of it can be shown, and is.
TEST(SurfaceObjective, CoversABoxRoom) {
    const PlanParams params = forSurface(Objective::Surface);
    const auto plan = planOf(boxRoom(), params);
    ASSERT_TRUE(plan->surface);
    EXPECT_GE(plan->surface->rateOf(plan->surface->seen), 0.99);
    EXPECT_GE(plan->surface->rateOf(plan->surface->coverable), 0.95);
    EXPECT_GE(plan->surface->covered, 0.95 * plan->surface->coverable);
    const auto inState = [&](PatchState state) {
        return std::ranges::count(plan->surface->measured, state, &MeasuredPatch::state);
    };
    EXPECT_EQ(plan->surface->measured.size(), static_cast<std::size_t>(plan->surface->patches));
    EXPECT_EQ(inState(PatchState::Unseen), plan->surface->patches - plan->surface->seen);
    EXPECT_EQ(inState(PatchState::Covered), plan->surface->covered);
    EXPECT_LE(plan->trajectory.frames.size(), 300U);
    EXPECT_EQ(plan->trajectory_metrics.frame_collision_rate, 0.0);
}

TEST(SurfaceGoal, TellsWhetherMoreDirectionsArePossible) {
    const Scene scene = boxRoom();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, CameraParams{});
    SurfaceGoal goal;
    goal.surface = {{{{4.0, 1.5, 1.2}, {-1, 0, 0}},
                     {{4.0, 1.6, 1.2}, {-1, 0, 0}},
                     {{4.0, 1.4, 1.2}, {-1, 0, 0}},
                     {{0.0, 1.5, 1.2}, {1, 0, 0}}},
                    0.1};
    goal.sharp_m = 5.0;
    goal.directions = 3;
    goal.coverable = {1, 2, 3, 3};
    Trajectory trajectory;
    trajectory.frames.emplace_back().pose = lookAt({1, 1.5, 1.2}, {4, 1.5, 1.2});
    const auto one = measureSurface(goal, views, trajectory, {});
    ASSERT_TRUE(one);
    const std::vector<PatchState> expected = {PatchState::SeenAtBest, PatchState::Seen,
                                              PatchState::Seen, PatchState::Unseen};
    for (std::size_t p = 0; p < expected.size(); ++p) {
        EXPECT_EQ(one->measured[p].state, expected[p]) << p;
    }
    for (const double y : {0.5, 2.5}) {
        trajectory.frames.emplace_back().pose = lookAt({1.5, y, 1.2}, {4, 1.5, 1.2});
    }
    const auto three = measureSurface(goal, views, trajectory, {});
    ASSERT_TRUE(three);
    EXPECT_EQ(three->measured[0].state, PatchState::Covered);
    EXPECT_EQ(three->measured[3].state, PatchState::Unseen);
    EXPECT_EQ(three->covered, 3);
    EXPECT_EQ(three->seen, 3);
}

TEST(SurfaceObjective, IsCountedAsABruteForceRayCasterCounts) {
    for (const Objective objective : {Objective::Surface, Objective::Both}) {
        for (const int max_frames : {20, 120}) {
            PlanParams params = forSurface(objective, max_frames);
            params.coverage.surface_mm_px = 3.0;  // 1.7 m
            const Goal goal(test::furnishedRoom(), params);
            const auto plan = planOf(goal.scene, params);
            ASSERT_TRUE(plan->surface);
            const SurfaceShare& shown = *plan->surface;
            const Counted counted = countByHand(goal, plan->trajectory, params);
            EXPECT_EQ(shown.patches, static_cast<int>(goal.found.goal.surface.patches.size()));
            const int rounding = shown.patches / 400;
            EXPECT_NEAR(shown.seen, counted.seen, rounding);
            EXPECT_NEAR(shown.covered, counted.covered, rounding);
            EXPECT_LE(shown.covered, shown.coverable);
        }
    }
}

TEST(SurfaceObjective, ShowsMoreSurfaceWithEachFrame) {
    int seen = 0;
    int covered = 0;
    for (const int max_frames : {5, 20, 80}) {
        const auto plan = planOf(test::furnishedRoom(), forSurface(Objective::Surface, max_frames));
        ASSERT_TRUE(plan->surface);
        EXPECT_LE(plan->trajectory.frames.size(), static_cast<std::size_t>(max_frames));
        EXPECT_GT(plan->surface->seen, seen);
        EXPECT_GT(plan->surface->covered, covered);
        seen = plan->surface->seen;
        covered = plan->surface->covered;
    }
}

TEST(SurfaceObjective, BothKeepsTheObjectsAndAddsSurface) {
    const Scene scene = test::furnishedRoom();
    const auto objects = planOf(scene, forSurface(Objective::Objects));
    const auto both = planOf(scene, forSurface(Objective::Both));
    const auto surface = planOf(scene, forSurface(Objective::Surface));
    EXPECT_FALSE(objects->surface);
    EXPECT_EQ(both->capture_metrics.well_captured, objects->capture_metrics.well_captured);
    const auto isSurfaceView = [](const Plan& plan, int key) {
        return plan.position_points[key].surface_view;
    };
    ASSERT_GT(both->key_frames.size(), objects->key_frames.size());
    for (std::size_t i = 0; i < both->key_frames.size(); ++i) {
        EXPECT_EQ(isSurfaceView(*both, both->key_frames[i]), i >= objects->key_frames.size());
    }
    for (const int key : surface->key_frames) EXPECT_TRUE(isSurfaceView(*surface, key));
    for (const LedgerRow& row : surface->ledger) {
        if (row.captured) continue;
        EXPECT_NE(row.reason.find("objective=surface"), std::string::npos) << row.reason;
    }
}

TEST(SurfaceObjective, IsTheSameForAnyNumberOfThreads) {
    const Scene scene = test::furnishedRoom();
    const PlanParams params = forSurface(Objective::Both, 100);
    setThreadCount(1);
    const auto one = planOf(scene, params);
    setThreadCount(4);
    const auto four = planOf(scene, params);
    setThreadCount(0);
    ASSERT_EQ(one->trajectory.frames.size(), four->trajectory.frames.size());
    for (std::size_t i = 0; i < one->trajectory.frames.size(); ++i) {
        EXPECT_EQ(one->trajectory.frames[i].pose, four->trajectory.frames[i].pose) << i;
    }
    EXPECT_EQ(one->surface->seen, four->surface->seen);
    EXPECT_EQ(one->surface->covered, four->surface->covered);
}

TEST(SurfaceObjective, KeepsToThePitchBandAndARobotsHeight) {
    PlanParams params = forSurface(Objective::Surface, 150);
    params.body.camera_preset = CameraPreset::Robot;
    applyCameraPreset(params);
    const auto plan = planOf(test::furnishedRoom(), params);
    ASSERT_TRUE(plan->surface);
    EXPECT_GT(plan->surface->seen, 0);
    for (const TrajectoryFrame& frame : plan->trajectory.frames) {
        EXPECT_NEAR(frame.pose.forward().z(), 0.0, 1e-6);
        EXPECT_NEAR(frame.pose.position.z(), params.body.camera_height_m, 0.01);
    }
}

TEST(SurfaceObjective, IsFollowedAfterAChangeAsFromScratch) {
    const auto scene = std::make_shared<const Scene>(test::furnishedRoom());
    Pipeline pipeline(scene);
    const auto run = [&](Pipeline& with, const PlanParams& params) {
        const auto plan = with.run(params, JobContext{});
        EXPECT_TRUE(plan.has_value());
        return *plan;
    };
    for (const Objective objective :
         {Objective::Surface, Objective::Objects, Objective::Both, Objective::Surface}) {
        const PlanParams params = forSurface(objective, 60);
        const auto changed = run(pipeline, params);
        Pipeline fresh(scene);
        const auto made = run(fresh, params);
        EXPECT_EQ(changed->key_frames, made->key_frames);
        EXPECT_EQ(changed->surface.has_value(), objective != Objective::Objects);
        ASSERT_EQ(changed->trajectory.frames.size(), made->trajectory.frames.size());
        for (std::size_t i = 0; i < made->trajectory.frames.size(); ++i) {
            EXPECT_EQ(changed->trajectory.frames[i].pose, made->trajectory.frames[i].pose);
        }
    }
}

TEST(SurfaceObjective, RefusesAResolutionThatNoPositionCanHave) {
    PlanParams params = forSurface(Objective::Surface);
    params.coverage.surface_mm_px = 0.1;  // at 6 cm
    const Status status = validate(params);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::Usage);
    EXPECT_NE(status.error().message.find("raise surface_mm_px"), std::string::npos);
    params.coverage.objective = Objective::Objects;
    EXPECT_TRUE(validate(params));
}

}  // namespace dollytrack::planning::surface_views_test
