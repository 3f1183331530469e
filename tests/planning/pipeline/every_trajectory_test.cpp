// Trajectories of all kinds through rooms of all kinds, verified by the slow, independent checker.

#include "engine/core/random.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/pipeline/pipeline.h"
#include "planning/smoothing/smooth_path.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"
#include "tests/planning/support/slow_checker.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace dollytrack::planning::every_trajectory_test {
namespace {

using test_support::SlowChecker;

/// Objects that sampling would miss: cords of 2 mm, panes without thickness, thin legs, a mobile.
Scene thinThings(unsigned seed) {
    test::SceneBuilder builder;
    Random random(seed);
    builder.room({0, 0, 0}, {6, 5, 2.6});
    for (int i = 0; i < 24; ++i) {
        const double x = random.uniform(0.6, 5.4);
        const double y = random.uniform(0.6, 4.4);
        builder.object("thing " + std::to_string(i));
        switch (i % 4) {
            case 0:  // a lamp on its cord
                builder.box({x, y, 2.2}, {0.002, 0.002, 0.8}).box({x, y, 1.75}, {0.2, 0.2, 0.1});
                break;
            case 1:  // a table on legs
                builder.box({x, y, 0.7}, {0.8, 0.5, 0.02});
                for (const double side : {-0.37, 0.37}) {
                    builder.box({x + side, y, 0.35}, {0.015, 0.015, 0.7});
                }
                break;
            case 2:  // a pane of glass with a cup behind it
                builder.quad({x, y, 0.0}, {0.7, 0.2, 0.0}, {0.0, 0.0, 1.6});
                builder.object("cup " + std::to_string(i))
                    .box({x + 0.3, y + 0.4, 0.05}, {0.08, 0.08, 0.1});
                break;
            default:  // a wire across
                builder.box({x, y, random.uniform(1.0, 2.0)}, {1.2, 0.003, 0.003},
                            random.uniform(0.0, 3.1));
        }
    }
    return builder.build();
}

struct Case {
    std::string name;
    Scene scene;
};

std::vector<Case> allRooms() {
    std::vector<Case> cases;
    cases.push_back({"furnished", test::furnishedRoom()});
    cases.push_back({"wide door", test::twoRoomsWithDoor(0.9)});
    cases.push_back({"narrow door", test::twoRoomsWithDoor(0.36)});
    for (const unsigned seed : {1U, 2U, 3U}) {
        cases.push_back({"thin things " + std::to_string(seed), thinThings(seed)});
    }
    return cases;
}

}  // namespace

TEST(EveryTrajectory, KeepsTheSphereOutOfAllTriangles) {
    long places = 0;
    for (Case& one : allRooms()) {
        const auto scene = std::make_shared<const Scene>(std::move(one.scene));
        const SlowChecker checker(*scene);
        Pipeline pipeline(scene);
        for (const double radius : {0.05, 0.15}) {
            for (const double corner : {0.05, 0.3, 1.0}) {
                for (const bool shaken : {false, true}) {
                    PlanParams params;
                    params.camera.camera_radius_m = radius;
                    params.camera.near_m = 0.03;
                    params.smoothing.corner_distance_m = corner;
                    params.path.path_mode = shaken ? PathMode::LongestBranch : PathMode::Tour;
                    if (shaken) params.shake.shake = ShakeKind::Handheld;
                    const auto plan = pipeline.run(params, JobContext{});
                    ASSERT_TRUE(plan) << one.name << ": " << describe(plan.error());
                    SCOPED_TRACE(one.name + ", radius " + std::to_string(radius) + ", corner " +
                                 std::to_string(corner));
                    const SlowChecker::Found found = checker.check(**plan, radius, shaken);
                    EXPECT_EQ(found.touching, 0) << found.position.transpose();
                    places += found.places;
                    if (found.places == 0) continue;
                    // The reported position has the reported clearance, and no other is tighter.
                    const MinimumClearance& clearance =
                        (*plan)->trajectory_metrics.minimum_clearance;
                    EXPECT_NEAR(clearance.clearance_m, found.clearance_m, 1.2e-3);
                    EXPECT_LE(clearance.clearance_m, found.clearance_m + 1.2e-4);
                    EXPECT_NEAR(checker.distance(clearance.position), clearance.clearance_m, 2e-5);
                }
            }
        }
    }
    EXPECT_GT(places, 300'000);
}

// A test of the checker itself: corners cut without collision checks hit objects, and it reports
// that.
TEST(EveryTrajectory, TheCheckerFindsCornersCutBlindly) {
    int touching = 0;
    int unproven = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const auto scene = std::make_shared<const Scene>(thinThings(seed));
        Pipeline pipeline(scene);
        PlanParams params;
        const auto plan = pipeline.run(params, JobContext{});
        ASSERT_TRUE(plan);
        const auto rays = pipeline.rays();
        const auto space = pipeline.freeSpace();
        const ViewEstimator views(*scene, *rays, params.camera);
        const SweptSphere sphere(*rays, *space, params.camera.camera_radius_m);
        Plan blind;
        for (const CameraPath& path : (*plan)->paths) {
            blind.smooth_paths.push_back(smoothBlindly(path, 1.0, {views, *space, sphere}));
            unproven += blind.smooth_paths.back().collisions;
        }
        touching += SlowChecker(*scene).check(blind, params.camera.camera_radius_m, false).touching;
    }
    EXPECT_GT(touching, 0);
    EXPECT_GT(unproven, 0);
}

}  // namespace dollytrack::planning::every_trajectory_test
