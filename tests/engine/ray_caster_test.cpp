#include "engine/geometry/ray_caster.h"

#include "engine/core/random.h"
#include "engine/scene/move_object.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <vector>

namespace dollytrack::ray_caster_test {

TEST(RayCaster, HitsTheFirstSurfaceAtItsExactDistance) {
    const Scene scene = test::furnishedRoom();
    const RayCaster rays(scene);
    const RayHit sofa = rays.cast({2.0, 1.5, 0.4}, {-1, 0, 0});
    ASSERT_NE(sofa.object_id, 0);
    EXPECT_EQ(scene.object(sofa.object_id).name, "sofa");
    EXPECT_NEAR(sofa.distance, 1.1, 1e-5);
    const Object& object = scene.object(sofa.object_id);
    EXPECT_GE(sofa.triangle, object.first_triangle);
    EXPECT_LT(sofa.triangle, object.first_triangle + object.triangle_count);

    const RayHit wall = rays.cast({2.0, 1.5, 1.2}, {-1, 0, 0});
    EXPECT_EQ(scene.object(wall.object_id).name, "wall_west");
    EXPECT_EQ(rays.cast({2.0, 1.5, 1.2}, {-1, 0, 0}, 1.9).object_id, 0);
}

TEST(RayCaster, MeetsObjectLooksThroughEverythingElse) {
    const Scene scene = test::furnishedRoom();
    const RayCaster rays(scene);
    const int wall = 5;
    ASSERT_EQ(scene.object(wall).name, "wall_west");
    EXPECT_TRUE(rays.meetsObject(wall, {2.0, 1.5, 0.4}, {-1, 0, 0}));
    EXPECT_TRUE(rays.meetsObject(wall, {2.0, 1.5, 0.4}, {-1, 0, 0}, 2.001));
    EXPECT_FALSE(rays.meetsObject(wall, {2.0, 1.5, 0.4}, {-1, 0, 0}, 1.999));
    EXPECT_FALSE(rays.meetsObject(wall, {2.0, 1.5, 0.4}, {1, 0, 0}));
}

TEST(RayCaster, RaysWithImpossibleNumbersHitNothing) {
    const Scene scene = test::furnishedRoom();
    const RayCaster rays(scene);
    const Eigen::Vector3d inside(2.0, 1.5, 0.4);
    for (const double number : {1e20, -1e300, std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()}) {
        const Eigen::Vector3d bad(number, 0, 0);
        EXPECT_EQ(rays.cast(bad, {-1, 0, 0}).object_id, 0);
        EXPECT_EQ(rays.cast(inside, bad).object_id, 0);
        EXPECT_FALSE(rays.meetsObject(5, inside, bad));
        std::vector<RayHit> hits;
        rays.castBundle(inside, std::vector<RayCaster::BundleRay>{{{-1, 0, 0}}, {bad}}, 0.0, hits);
        EXPECT_NE(hits[0].object_id, 0);
        EXPECT_EQ(hits[1].object_id, 0);
        rays.castBundle(bad, std::vector<RayCaster::BundleRay>{{{-1, 0, 0}}}, 0.0, hits);
        EXPECT_EQ(hits[0].object_id, 0);
    }
}

TEST(RayCaster, SeesOnlyThroughAir) {
    const Scene scene = test::twoRoomsWithDoor(0.9);
    const RayCaster rays(scene);
    EXPECT_TRUE(rays.sees({1, 1.5, 1}, {5, 1.5, 1}));
    EXPECT_FALSE(rays.sees({1, 0.5, 1}, {5, 0.5, 1}));
}

TEST(RayCaster, ClosestPointAgreesWithBruteForce) {
    const Scene scene = test::furnishedRoom();
    const RayCaster rays(scene);
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        const Eigen::Vector3d p(random.uniform(-1, 5), random.uniform(-1, 4),
                                random.uniform(-1, 3));
        // Minimum over a fine grid of each triangle: an upper bound with an error of at most the
        // grid spacing.
        double best = 1e9;
        for (const Triangle& t : scene.triangles) {
            const Eigen::Vector3d a = scene.positions[t[0]].cast<double>();
            const Eigen::Vector3d b = scene.positions[t[1]].cast<double>();
            const Eigen::Vector3d c = scene.positions[t[2]].cast<double>();
            constexpr int kSteps = 60;
            for (int u = 0; u <= kSteps; ++u) {
                for (int v = 0; u + v <= kSteps; ++v) {
                    const Eigen::Vector3d q = a + (b - a) * u / kSteps + (c - a) * v / kSteps;
                    best = std::min(best, (q - p).norm());
                }
            }
        }
        const ClosestPoint closest = rays.closest(p);
        ASSERT_NE(closest.object_id, 0);
        EXPECT_LE(closest.distance, best + 1e-5);
        EXPECT_GE(closest.distance, best - 0.12);
        EXPECT_NEAR((closest.point - p).norm(), closest.distance, 1e-9);
    }
}

TEST(RayCaster, ClosestFindsNothingBeyondItsRadius) {
    const RayCaster rays(test::furnishedRoom());
    EXPECT_EQ(rays.closest({2.0, 1.0, 1.6}, 0.05).object_id, 0);
}

TEST(RayCaster, IsClearAsFarAsTheClosestPoint) {
    const Scene scene = test::furnishedRoom();
    const RayCaster rays(scene);
    Random random(6);
    for (int i = 0; i < 2000; ++i) {
        const Eigen::Vector3d p(random.uniform(-1, 5), random.uniform(-1, 4),
                                random.uniform(-1, 3));
        const double closest = rays.closest(p).distance;
        EXPECT_TRUE(rays.isClear(p, closest * (1.0 - 1e-9)));
        EXPECT_FALSE(rays.isClear(p, closest * (1.0 + 1e-9) + 1e-12));
        const double distance = random.uniform(0.0, 0.5);
        EXPECT_EQ(rays.isClear(p, distance), closest >= distance);
    }
}

// Shared geometry gives the same results as a new caster, also after the earlier one is destroyed.
TEST(RayCaster, MadeOfAnEarlierOneAnswersAsFromTheScene) {
    Random random(8, 2);
    Scene scene = test::furnishedRoom();
    auto kept = std::make_unique<RayCaster>(scene);
    for (int step = 0; step < 20; ++step) {
        const int id =
            1 + static_cast<int>(random.below(static_cast<std::uint32_t>(scene.objects.size())));
        moveObject(scene, id, {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0.0},
                   random.uniform(-3.0, 3.0));
        auto next = std::make_unique<RayCaster>(scene, *kept, std::vector<int>{id});
        kept = std::move(next);
        const RayCaster fresh(scene);
        for (int i = 0; i < 300; ++i) {
            const Eigen::Vector3d from(random.uniform(0, 4), random.uniform(0, 3), 1.2);
            const Eigen::Vector3d way(random.normal(), random.normal(), random.normal());
            const RayHit a = kept->cast(from, way);
            const RayHit b = fresh.cast(from, way);
            EXPECT_EQ(a.object_id, b.object_id);
            EXPECT_EQ(a.distance, b.distance);
            EXPECT_EQ(a.triangle, b.triangle);
            EXPECT_EQ(kept->meetsObject(id, from, way), fresh.meetsObject(id, from, way));
            EXPECT_EQ(kept->closest(from).distance, fresh.closest(from).distance);
            EXPECT_EQ(kept->closest(from).object_id, fresh.closest(from).object_id);
        }
    }
}

// Two boxes share a side; which one is reported must not depend on other objects.
TEST(RayCaster, NamesTheLowestOfThingsThatTouch) {
    Random random(4, 2);
    for (int others = 0; others < 60; ++others) {
        test::SceneBuilder builder;
        builder.object("low").box({0, 0, 0.5}, {1, 1, 1});   // 1
        builder.object("high").box({0, 0, 1.5}, {1, 1, 1});  // 2
        for (int i = 0; i < others; ++i) {
            const Eigen::Vector3d at(random.uniform(-4, 4), random.uniform(-4, 4), 5.0);
            builder.object("other").box(at, {0.3, 0.3, 0.3});
        }
        const Scene scene = builder.build();
        const RayCaster rays(scene);
        for (int i = 0; i < 20; ++i) {
            // Beside the seam at its height, where both boxes are equally near.
            const Eigen::Vector3d point(0.5 + random.uniform(0.01, 0.3), random.uniform(-0.4, 0.4),
                                        1.0);
            EXPECT_EQ(rays.closest(point, 0.5).object_id, 1) << others;
            EXPECT_NEAR(rays.closest(point, 0.5).distance, point.x() - 0.5, 1e-12);
        }
    }
}

}  // namespace dollytrack::ray_caster_test
