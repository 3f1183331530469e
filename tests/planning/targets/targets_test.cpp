#include "engine/geometry/ray_caster.h"
#include "planning/plan_params.h"
#include "planning/targets/observation_points.h"
#include "planning/targets/supports.h"
#include "planning/visibility/view_estimator.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <map>

namespace dollytrack::planning::targets_test {
namespace {

SupportRelation supportOf(const Scene& scene, const std::string& name) {
    const RayCaster rays(scene);
    const auto supports = findSupports(scene, rays, {});
    for (const Object& object : scene.objects) {
        if (object.name == name) return supports[object.id - 1];
    }
    ADD_FAILURE() << "no object " << name;
    return {};
}

}  // namespace

TEST(Supports, AMugOnATableIsSupportedByIt) {
    const Scene scene = test::furnishedRoom();
    const SupportRelation mug = supportOf(scene, "mug");
    EXPECT_EQ(mug.kind, TargetKind::Support);
    EXPECT_EQ(scene.object(mug.supporter).name, "table");
    EXPECT_EQ(supportOf(scene, "sofa").kind, TargetKind::Single);
}

TEST(Supports, APictureHangsAtItsWallAndFacesTheRoom) {
    const Scene scene = test::furnishedRoom();
    const SupportRelation picture = supportOf(scene, "picture");
    EXPECT_EQ(picture.kind, TargetKind::Suspension);
    EXPECT_EQ(scene.object(picture.supporter).name, "wall_north");
    EXPECT_LT(picture.outward.y(), -0.99);
}

TEST(Supports, WhatIsCarriedByTheBuildingIsHeldByItAllTheSame) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("sofa").box({1, 1, 0.4}, {1.8, 0.9, 0.8});
    builder.object("lamp").box({2, 2, 2.3}, {0.2, 0.2, 0.58});  // below the ceiling
    builder.object("balloon").box({3, 1, 1.2}, {0.3, 0.3, 0.3});
    const Scene scene = builder.build();
    const SupportRelation sofa = supportOf(scene, "sofa");
    EXPECT_EQ(scene.object(sofa.holder).name, "floor");
    EXPECT_FALSE(sofa.hangs);
    EXPECT_EQ(sofa.supporter, 0) << "the floor makes no point of its own";
    const SupportRelation lamp = supportOf(scene, "lamp");
    EXPECT_EQ(scene.object(lamp.holder).name, "ceiling");
    EXPECT_TRUE(lamp.hangs);
    EXPECT_EQ(supportOf(scene, "balloon").holder, 0);
}

TEST(Supports, AThingBetweenBoardsIsSeenThroughTheOpenSide) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("shelf")
        .box({2.0, 2.98, 1.0}, {1.0, 0.02, 2.0})    // back, at the north wall
        .box({2.0, 2.80, 0.50}, {1.0, 0.36, 0.02})  // boards
        .box({2.0, 2.80, 1.00}, {1.0, 0.36, 0.02})
        .box({1.5, 2.80, 1.0}, {0.02, 0.36, 2.0})  // sides
        .box({2.5, 2.80, 1.0}, {0.02, 0.36, 2.0});
    builder.object("vase").box({2.0, 2.80, 0.61}, {0.1, 0.1, 0.2});
    const Scene scene = builder.build();
    const SupportRelation vase = supportOf(scene, "vase");
    EXPECT_EQ(vase.kind, TargetKind::Shelf);
    EXPECT_EQ(scene.object(vase.supporter).name, "shelf");
    EXPECT_LT(vase.outward.y(), -0.99);
}

// A cup in a small cupboard on the wall: the cup must not be taken for a wall.
TEST(Supports, WhatLiesInsideHoldsNothingUp) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("cupboard").box({2.0, 2.88, 1.6}, {0.4, 0.22, 0.4});
    builder.object("cup").box({2.0, 2.88, 1.6}, {0.08, 0.08, 0.1});
    const Scene scene = builder.build();
    const SupportRelation cupboard = supportOf(scene, "cupboard");
    EXPECT_EQ(cupboard.kind, TargetKind::Suspension);
    EXPECT_EQ(scene.object(cupboard.supporter).name, "wall_north");
}

TEST(ObservationPoints, EveryTargetOfACrowdedTableIsInExactlyOne) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("table").box({2, 1.5, 0.36}, {1.6, 0.9, 0.72});
    for (int i = 0; i < 24; ++i) {
        // A grid that is nearly as deep as it is wide, so that halves are split along both axes.
        builder.object("furniture_" + std::to_string(i))
            .box({1.4 + 0.24 * (i % 6), 1.2 + 0.2 * (i / 6), 0.76}, {0.08, 0.08, 0.08});
    }
    const Scene scene = builder.build();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, {});
    const auto points = setObservationPoints(views, {}, {});
    std::map<int, int> seen;
    for (const ObservationPoint& point : points) {
        for (const int id : point.objects) ++seen[id];
        EXPECT_NEAR(point.direction.norm(), 1.0, 1e-9);
    }
    int targets = 0;
    for (const Object& object : scene.objects) {
        if (object.role != Role::Target) continue;
        ++targets;
        EXPECT_EQ(seen[object.id], 1) << object.name;
    }
    EXPECT_EQ(targets, 25);
    EXPECT_GT(points.size(), 5U);  // one view cannot hold them all at a useful size
}

}  // namespace dollytrack::planning::targets_test
