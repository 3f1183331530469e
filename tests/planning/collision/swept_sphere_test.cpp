#include "planning/collision/swept_sphere.h"

#include "engine/core/random.h"
#include "engine/geometry/ray_caster.h"
#include "planning/free_space/free_space.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace dollytrack::planning::swept_sphere_test {
namespace {

struct World {
    Scene scene;
    RayCaster rays;
    FreeSpace free_space;

    explicit World(Scene made)
        : scene(std::move(made)),
          rays(scene),
          free_space(std::move(*FreeSpace::build(scene, rays, {}, {}, {}))) {}
};

}  // namespace

// A lamp cord 2 mm thick: sampling at the cells' size would step over it.
TEST(SweptSphere, MeetsAThinCord) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("cord").box({2.013, 1.5, 2.0}, {0.002, 0.002, 1.2});
    const World world(builder.build());
    const SweptSphere sphere(world.rays, world.free_space, 0.1);
    const SweepResult hit = sphere.segment({0.5, 1.5, 1.9}, {3.5, 1.5, 1.9});
    EXPECT_FALSE(hit.free);
    ASSERT_NE(hit.object_id, 0);
    EXPECT_EQ(world.scene.object(hit.object_id).name, "cord");
    EXPECT_NEAR(hit.collision.x(), 2.012 - 0.1, 0.01);
    EXPECT_TRUE(sphere.segment({0.5, 1.7, 1.9}, {3.5, 1.7, 1.9}).free);
}

// A gap slightly wider than the sphere is passable, a slightly narrower one is not.
TEST(SweptSphere, TheTightestGapIsTheDiameter) {
    for (const double gap : {0.196, 0.206}) {
        test::SceneBuilder builder;
        builder.room({0, 0, 0}, {4, 3, 2.6});
        builder.object("left").box({2, 0.5 * (1.5 - gap / 2), 1.3}, {0.02, 1.5 - gap / 2, 2.6});
        builder.object("right").box({2, 3 - 0.5 * (1.5 - gap / 2), 1.3},
                                    {0.02, 1.5 - gap / 2, 2.6});
        Scene scene = builder.build();
        const RayCaster rays(scene);
        // Finer than the gap, so that the map of free space does not decide.
        const auto map = FreeSpace::build(scene, rays, {}, {0.02}, {});
        ASSERT_TRUE(map.has_value());
        const SweptSphere sphere(rays, *map, 0.1);
        EXPECT_EQ(sphere.segment({1, 1.5, 1.3}, {3, 1.5, 1.3}).free, gap > 0.2) << gap;
    }
}

TEST(SweptSphere, AgreesWithDenseSamplingOfCurves) {
    const World world(test::furnishedRoom());
    const SweptSphere sphere(world.rays, world.free_space, 0.1);
    Random random(11);
    int free = 0;
    int blocked = 0;
    for (int i = 0; i < 400; ++i) {
        const auto point = [&] {
            return Eigen::Vector3d(random.uniform(0.2, 3.8), random.uniform(0.2, 2.8),
                                   random.uniform(0.2, 2.4));
        };
        const Eigen::Vector3d a = point();
        const Eigen::Vector3d b = point();
        const Eigen::Vector3d c = point();
        double smallest = 1e9;
        for (int k = 0; k <= 1000; ++k) {
            const double t = k / 1000.0;
            const double u = 1.0 - t;
            smallest = std::min(smallest,
                                world.rays.closest(u * u * a + 2 * u * t * b + t * t * c).distance);
        }
        const SweepResult sweep = sphere.bezier(a, b, c);
        if (sweep.free) {
            ++free;
            EXPECT_GE(smallest, 0.1);
            EXPECT_LE(sweep.min_clearance_m, smallest + 0.01);
        } else {
            ++blocked;
            // A refused move is really blocked, within a small tolerance, or leaves the free space.
            if (sweep.object_id != 0) {
                EXPECT_LT(smallest, 0.1 + 0.02);
            }
        }
    }
    EXPECT_GT(free, 50);
    EXPECT_GT(blocked, 50);
}

}  // namespace dollytrack::planning::swept_sphere_test
