#include "engine/geometry/ray_caster.h"
#include "planning/collision/swept_sphere.h"
#include "planning/pipeline/pipeline.h"
#include "planning/viewpoints/gap_test.h"
#include "planning/visibility/view_estimator.h"
#include "tests/planning/support/map_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace dollytrack::planning::scan_test {
namespace {

using test_support::kFloorLook;
using test_support::kWallLook;
using V = Eigen::Vector3d;

/// A rectangle cut into squares of 0.125 m that faces along edge_u x edge_v, as a scan's mesh.
void addMesh(test::SceneBuilder& builder, const V& corner, const V& edge_u, const V& edge_v) {
    constexpr double kEdge = 0.125;
    const int across = static_cast<int>(std::lround(edge_u.norm() / kEdge));
    const int up = static_cast<int>(std::lround(edge_v.norm() / kEdge));
    for (int i = 0; i < across; ++i) {
        for (int k = 0; k < up; ++k) {
            builder.quad(corner + edge_u * i / across + edge_v * k / up, edge_u / across,
                         edge_v / up);
        }
    }
}

/// A room of 8 x 4 x 2.5 m of which the part with x < 5 was scanned, without its ceiling. A wall at
/// x = 5, seen from the scanned side, hides the rest but for a doorway of 1 m, through which a bit
/// of the far wall was scanned, and for strips of its walls.
Scene partialScan() {
    const V up(0, 0, 2.5);
    test::SceneBuilder builder;
    builder.object("floor", kFloorLook);
    addMesh(builder, {0, 0, 0}, {5, 0, 0}, {0, 4, 0});
    builder.object("south", kWallLook);
    addMesh(builder, {5, 0, 0}, {-5, 0, 0}, up);
    builder.object("north", kWallLook);
    addMesh(builder, {0, 4, 0}, {5, 0, 0}, up);
    builder.object("west", kWallLook);
    addMesh(builder, {0, 0, 0}, {0, 4, 0}, up);
    builder.object("inner", kWallLook);
    addMesh(builder, {5, 4, 0}, {0, -3, 0}, up);
    builder.object("far", kWallLook);
    addMesh(builder, {8, 1, 0}, {0, -1, 0}, up);
    builder.object("rest", kWallLook);  // a strip of each wall, below the ceiling and at the floor
    for (const double z : {0.0, 2.0}) {
        addMesh(builder, {8, 0, z}, {-3, 0, 0}, 0.2 * up);
        addMesh(builder, {5, 4, z}, {3, 0, 0}, 0.2 * up);
        addMesh(builder, {8, 4, z}, {0, -3, 0}, 0.2 * up);
    }
    builder.object("box").box({2, 1, 0.25}, {0.5, 0.5, 0.5});
    builder.object("picture");
    addMesh(builder, {4.97, 3, 1.25}, {0, -0.5, 0}, {0, 0, 0.5});
    // Both sides were scanned: it is equally visible from behind the wall.
    builder.object("board").box({5.2, 2.5, 1.25}, {0.05, 0.6, 0.6});
    return builder.build();
}

/// The share of all directions from a position that hit front faces minus the share that hit back
/// faces.
double frontsLessBacks(const Scene& scene, const RayCaster& rays, const V& from) {
    int sum = 0;
    constexpr int kDirections = 2000;
    for (int i = 0; i < kDirections; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
        const double r = std::sqrt(1.0 - z * z);
        const V direction(r * std::cos(2.4 * i), r * std::sin(2.4 * i), z);
        const RayHit hit = rays.cast(from, direction);
        if (hit.object_id == 0) continue;
        const Triangle& t = scene.triangles[hit.triangle];
        const Eigen::Vector3f a = scene.positions[t[0]];
        const V normal =
            (scene.positions[t[1]] - a).cross(scene.positions[t[2]] - a).cast<double>();
        sum += normal.dot(direction) < 0.0 ? 1 : -1;
    }
    return static_cast<double>(sum) / kDirections;
}

TEST(Scans, WhatWasNotScannedIsUnknownAndHoldsNoViewpoint) {
    const auto scene = std::make_shared<const Scene>(partialScan());
    Pipeline pipeline(scene);

    const auto plan = pipeline.run(PlanParams{}, PlanEdits{}, JobContext{});

    ASSERT_TRUE(plan) << describe(plan.error());
    const FreeSpace& map = *pipeline.freeSpace();
    ASSERT_TRUE(map.scannedShare().has_value());
    EXPECT_LT(*map.scannedShare(), 0.8);
    EXPECT_GT(*map.scannedShare(), 0.4);
    EXPECT_EQ(map.stateAt({2.5, 2.0, 1.2}), CellState::Free);
    EXPECT_EQ(map.stateAt({6.5, 2.5, 1.2}), CellState::Unknown);
    EXPECT_EQ(map.stateAt({7.5, 3.5, 1.2}), CellState::Unknown);
    ASSERT_FALSE((*plan)->key_frames.empty());
    const ViewEstimator views(*scene, *pipeline.rays(), PlanParams{}.camera);
    for (const PositionPoint& point : (*plan)->position_points) {
        EXPECT_LT(point.pose.position.x(), 5.0);
        EXPECT_GT(frontsLessBacks(*scene, *pipeline.rays(), point.pose.position), 0.2);
        EXPECT_GE(views.scannedShare(point.pose), 0.5);
    }
    for (const ObjectCapture& capture : (*plan)->captures) {
        const bool behind = scene->object(capture.object_id).name == "board";
        EXPECT_EQ(capture.well_captured, !behind) << scene->object(capture.object_id).name;
    }
}

TEST(Scans, AModelledRoomWithoutCeilingAndOneWallIsNoScan) {
    test::SceneBuilder builder;
    builder.object("floor", kFloorLook).quad({0, 0, 0}, {5, 0, 0}, {0, 4, 0});
    builder.object("south", kWallLook).quad({5, 0, 0}, {-5, 0, 0}, {0, 0, 2.5});
    builder.object("north", kWallLook).quad({0, 4, 0}, {5, 0, 0}, {0, 0, 2.5});
    builder.object("west", kWallLook).quad({0, 0, 0}, {0, 4, 0}, {0, 0, 2.5});
    builder.object("box").box({2, 1, 0.25}, {0.5, 0.5, 0.5});
    const Scene scene = builder.build();
    const RayCaster rays(scene);
    const FreeSpace map = test_support::map(scene);

    EXPECT_FALSE(map.scannedShare().has_value());
    EXPECT_EQ(map.stateAt({4.7, 2.0, 2.2}), CellState::Free);
    const Pose outwards = lookAt({4.0, 2.0, 1.2}, {9.0, 2.0, 1.2});
    EXPECT_EQ(ViewEstimator(scene, rays, CameraParams{}).scannedShare(outwards), 1.0);
}

// A cupboard stands 0.35 m in front of the wall, and an object lies behind it.
TEST(Scans, AGapBehindACupboardHoldsNoViewpoint) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {5, 4, 2.5});
    builder.object("cupboard").box({0.6, 2.0, 1.0}, {0.5, 1.6, 2.0});
    builder.object("thing").box({0.175, 2.0, 0.1}, {0.15, 0.2, 0.2});
    const auto scene = std::make_shared<const Scene>(builder.build());
    Pipeline pipeline(scene);

    const auto plan = pipeline.run(PlanParams{}, PlanEdits{}, JobContext{});

    ASSERT_TRUE(plan) << describe(plan.error());
    const SweptSphere sphere(*pipeline.rays(), *pipeline.freeSpace(), 0.1);
    const ViewEstimator views(*scene, *pipeline.rays(), PlanParams{}.camera);
    ASSERT_TRUE(sphere.fits({0.175, 2.0, 1.0}));  // the camera could stand there
    EXPECT_TRUE(isInGap(sphere, views, {0.175, 2.0, 1.0}));
    EXPECT_FALSE(isInGap(sphere, views, {0.12, 0.12, 2.38}));  // the room's corner
    EXPECT_FALSE(isInGap(sphere, views, {2.5, 2.0, 1.0}));
    const Eigen::AlignedBox3d gap(V(0.0, 1.5, 0.0), V(0.35, 2.5, 1.7));
    for (const PositionPoint& point : (*plan)->position_points) {
        EXPECT_FALSE(gap.contains(point.pose.position)) << point.pose.position.transpose();
    }
    bool refused = false;
    for (const ViewpointSearch& search : (*plan)->searches) {
        for (const Candidate& candidate : search.candidates) {
            refused |= candidate.verdict == Verdict::InGap;
            if (candidate.verdict == Verdict::Legal) {
                EXPECT_FALSE(gap.contains(candidate.position));
            }
        }
    }
    EXPECT_TRUE(refused);
}

}  // namespace
}  // namespace dollytrack::planning::scan_test
