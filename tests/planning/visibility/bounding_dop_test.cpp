#include "planning/visibility/bounding_dop.h"

#include "engine/core/random.h"
#include "engine/geometry/ray_caster.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace dollytrack::planning::bounding_dop_test {
namespace {

/// A ball of thin splinters, no two of them parallel.
Scene splinters(Random& random) {
    test::SceneBuilder builder;
    builder.object("splinters");
    for (int i = 0; i < 40; ++i) {
        const Eigen::Vector3d size(random.uniform(0.001, 0.6), random.uniform(0.001, 0.6), 0.001);
        builder.box({random.normal(), 3.0 + random.normal(), random.normal()}, size);
    }
    return builder.build();
}

Eigen::Vector3d anyDirection(Random& random) {
    return Eigen::Vector3d(random.normal(), random.normal(), random.normal());
}

/// Queries the direction as the last of several; the others must not matter.
float exitOf(const BoundingDop::FromOrigin& from, const Eigen::Vector3d& direction) {
    BoundingDop::FromOrigin::Directions directions;
    for (unsigned axis = 0; axis < 3; ++axis) {
        directions[axis].setConstant(axis == 2 ? -1.0F : 0.0F);
        directions[axis][BoundingDop::FromOrigin::kAtOnce - 1] =
            static_cast<float>(direction[static_cast<int>(axis)]);
    }
    return from.exits(directions)[BoundingDop::FromOrigin::kAtOnce - 1];
}

}  // namespace

TEST(BoundingDop, NeverSparesARayThatMeetsTheObject) {
    Random random(3);
    int met = 0;
    int spared = 0;
    for (int round = 0; round < 5; ++round) {
        Scene scene = splinters(random);
        scene.objects[0].box.yaw = random.uniform(-3.0, 3.0);
        const RayCaster rays(scene);
        const BoundingDop hull(scene, scene.objects[0]);
        for (int i = 0; i < 4000; ++i) {
            const Eigen::Vector3d origin = 4.0 * anyDirection(random);
            const Eigen::Vector3d at = Eigen::Vector3d(0, 3, 0) + 1.5 * anyDirection(random);
            const Eigen::Vector3d direction = at - origin;
            const float exit = exitOf(BoundingDop::FromOrigin(hull, origin), direction);
            const RayHit hit = rays.cast(origin, direction);
            spared += exit <= 0.0F;
            if (hit.object_id == 0) continue;
            ++met;
            EXPECT_GT(exit, hit.distance);
        }
    }
    EXPECT_GT(met, 500);
    EXPECT_GT(spared, 1000);  // otherwise it would save no rays
}

TEST(BoundingDop, IsExactForABoxInItsOwnAxes) {
    test::SceneBuilder builder;
    builder.object("box").box({2.0, 0, 0}, {1.0, 1.0, 1.0});
    const Scene scene = builder.build();
    const BoundingDop hull(scene, scene.objects[0]);
    const BoundingDop::FromOrigin origin(hull, {0, 0, 0});
    EXPECT_NEAR(exitOf(origin, {1, 0, 0}), 2.5, 1e-3);
    EXPECT_NEAR(exitOf(origin, {2, 0, 0}), 1.25, 1e-3);
    EXPECT_LT(exitOf(origin, {-1, 0, 0}), 0.0F);
    EXPECT_LT(exitOf(origin, {0, 1, 0}), 0.0F);
    EXPECT_LT(exitOf(origin, {1.5, 0.52, 0}), 0.0F);
    EXPECT_GT(exitOf(origin, {1.5, 0.48, 0}), 0.0F);
}

}  // namespace dollytrack::planning::bounding_dop_test
