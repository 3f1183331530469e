#include "engine/camera/intrinsics.h"
#include "engine/core/random.h"
#include "engine/geometry/ray_caster.h"
#include "planning/coverage/region_weights.h"
#include "planning/coverage/surface_patches.h"
#include "planning/free_space/free_space.h"
#include "planning/viewpoints/key_frames.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace dollytrack::planning::must_see_test {
namespace {

using test_support::planOf;

/// A room with a shelf in a corner, whose back side cannot be seen from anywhere.
Scene roomWithShelf() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {5, 4, 2.6});
    builder.object("shelf").box({4.6, 3.0, 0.9}, {0.6, 1.2, 1.8});
    builder.object("cube").box({0.5, 0.5, 0.25}, {0.5, 0.5, 0.5});
    return builder.build();
}

Region shelfRegion(bool must_see) {
    return {"shelf", {{4.6, 3.0, 0.9}, {0.4, 0.7, 1.0}, 0.0}, 1.0, must_see};
}

/// Random points of the five faces of the shelf that are not on the floor.
std::vector<Eigen::Vector3d> pointsOfShelf(Random& random, int count) {
    const Eigen::Vector3d low(4.3, 2.4, 0.0);
    const Eigen::Vector3d high(4.9, 3.6, 1.8);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < count; ++i) {
        Eigen::Vector3d point;
        for (int k = 0; k < 3; ++k) point[k] = random.uniform(low[k], high[k]);
        const auto face = random.below(5);
        point[face / 2] = face % 2 == 1 || face == 4 ? high[face / 2] : low[face / 2];
        points.push_back(point);
    }
    return points;
}

/// An independent implementation of "seen": in the image, hit by a ray, not too slanted, and near
/// enough for a patch of 0.1 m to be 8 pixels wide.
bool shows(const RayCaster& rays, const Intrinsics& k, const Pose& pose,
           const Eigen::Vector3d& point) {
    const Eigen::Vector3d p = pose.rotation.inverse() * (point - pose.position);
    if (p.z() < 0.05) return false;
    const double x = k.fx * p.x() / p.z() + k.cx;
    const double y = k.fy * p.y() / p.z() + k.cy;
    if (x < 0 || y < 0 || x >= k.width || y >= k.height) return false;
    if (0.1 * k.fx / p.norm() < 8.0) return false;
    const RayHit hit = rays.cast(pose.position, (point - pose.position).normalized());
    return hit.object_id != 0 && std::abs(hit.distance - p.norm()) < 0.011;
}

}  // namespace

TEST(MustSee, FramesShowTheSurfaceThatCanBeSeen) {
    const Scene scene = roomWithShelf();
    const RayCaster rays(scene);
    const PlanParams params;
    const Intrinsics k = makeIntrinsics(params.camera);
    const auto map = FreeSpace::build(scene, rays, params.camera, params.free_space);
    ASSERT_TRUE(map);
    Random random(4);
    std::vector<Eigen::Vector3d> seeable;
    const auto& cells = map->cells(0);
    for (const Eigen::Vector3d& point : pointsOfShelf(random, 1500)) {
        // From any position that the camera may take, looking straight at the point.
        bool seen = false;
        for (int i = 0; i < 400 && !seen; ++i) {
            const Eigen::Vector3d place =
                cells[random.below(static_cast<std::uint32_t>(cells.size()))].cast<double>();
            const Eigen::Vector3d way = (point - place).normalized();
            Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
            if (std::abs(point.y() - 2.4) < 1e-9 || std::abs(point.y() - 3.6) < 1e-9) {
                normal = Eigen::Vector3d::UnitY();
            }
            if (std::abs(point.z() - 1.8) < 1e-9) normal = Eigen::Vector3d::UnitZ();
            seen = std::abs(way.dot(normal)) > 0.18 && shows(rays, k, lookAt(place, point), point);
        }
        if (seen) seeable.push_back(point);
    }
    ASSERT_GT(seeable.size(), 700U);
    ASSERT_LT(seeable.size(), 1400U) << "the back of the shelf is in sight";
    const auto shareShown = [&](const Plan& plan) {
        const auto count = std::count_if(seeable.begin(), seeable.end(), [&](const auto& point) {
            return std::any_of(
                plan.trajectory.frames.begin(), plan.trajectory.frames.end(),
                [&](const TrajectoryFrame& frame) { return shows(rays, k, frame.pose, point); });
        });
        return static_cast<double>(count) / static_cast<double>(seeable.size());
    };
    PlanEdits edits;
    edits.regions = {shelfRegion(false)};
    EXPECT_LT(shareShown(*planOf(scene, edits)), 0.9) << "all is seen anyway: tests nothing";
    edits.regions = {shelfRegion(true)};
    for (const PathMode mode : {PathMode::Tour, PathMode::LongestBranch}) {
        PlanParams with = params;
        with.path.path_mode = mode;
        const auto plan = planOf(scene, edits, with);
        EXPECT_GE(shareShown(*plan), 0.95);
        ASSERT_EQ(plan->must_see.size(), 1U);
        EXPECT_GE(plan->must_see[0].rate(), 0.95);
        EXPECT_EQ(plan->must_see[0].name, "shelf");
        EXPECT_LT(plan->must_see[0].seeable, plan->must_see[0].patches);
        EXPECT_EQ(plan->trajectory_metrics.frame_collision_rate, 0.0);
    }
}

TEST(MustSee, PatchesCoverTheSurfaceOnceAndNoGroundCostsMore) {
    test::SceneBuilder builder;
    builder.object("ground").quad({-1000, -1000, 0}, {2000, 0, 0}, {0, 2000, 0});
    const Scene scene = builder.build();
    const SurfacePatches found = patchesIn(scene, {{0.5, 0.5, 0.0}, {0.5, 0.5, 0.2}, 0.0}, 0.1);
    EXPECT_DOUBLE_EQ(found.spacing_m, 0.1);
    EXPECT_GE(found.patches.size(), 100U);
    EXPECT_LE(found.patches.size(), 121U);  // a rim where the box ends on a cube's border
    for (const SurfacePatch& patch : found.patches) {
        EXPECT_NEAR(patch.point.z(), 0.0, 1e-9);
        EXPECT_NEAR(std::abs(patch.normal.z()), 1.0, 1e-9);
    }
    EXPECT_LE(patchesIn(scene, {{0, 0, 0}, {300, 300, 1}, 0.0}, 0.1).patches.size(), 6000U);
}

TEST(RegionWeights, WhatWeighsMoreComesFirstUnderABudget) {
    const Scene scene = test::furnishedRoom();
    for (const Object& object : scene.objects) {
        if (object.role != Role::Target) continue;
        PlanEdits edits;
        OrientedBox box = object.box;
        box.half_size += Eigen::Vector3d::Constant(0.01);
        edits.regions = {{"here", box, 50.0, false}};
        PlanParams params;
        params.timing.max_frames = 1;
        const auto plan = planOf(scene, edits, params);
        ASSERT_EQ(plan->trajectory.frames.size(), 1U);
        const auto row = std::find_if(plan->captures.begin(), plan->captures.end(),
                                      [&](const auto& one) { return one.object_id == object.id; });
        EXPECT_TRUE(row->captured) << object.name;
    }
}

TEST(RegionWeights, TheLargestRegionCountsAndNothingIsLostWithoutABudget) {
    const Scene scene = test::furnishedRoom();
    const OrientedBox all{{2, 1.5, 1.3}, {5, 5, 5}, 0.0};
    EXPECT_TRUE(objectWeights(scene, {}).empty());
    EXPECT_TRUE(objectWeights(scene, {{"a", all, 1.0, true}}).empty());
    for (const double weight : objectWeights(scene, {{"a", all, 3.0}, {"b", all, 0.5}})) {
        EXPECT_EQ(weight, 3.0);
    }
    // Without a budget, weights cost no object its capture.
    PlanEdits edits;
    OrientedBox half = all;
    half.half_size.x() = 2.0;
    edits.regions = {{"a", half, kSmallestWeight, false}};
    EXPECT_EQ(planOf(scene, edits)->capture_metrics.captured,
              planOf(scene)->capture_metrics.captured);
}

}  // namespace dollytrack::planning::must_see_test
