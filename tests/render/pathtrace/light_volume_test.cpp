#include "render/light/light_volume.h"

#include "engine/core/random.h"
#include "render/pathtrace/path_tracer.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::render::light_volume_test {
namespace {

using dollytrack::test::furnishedRoom;
using dollytrack::test::SceneBuilder;

constexpr double kPi = std::numbers::pi;

std::size_t cellAt(const LightVolume& volume, const Eigen::Vector3d& point) {
    const Eigen::Vector3d at = (point - volume.low) / volume.cell_m;
    return volume.index(static_cast<int>(at.x()), static_cast<int>(at.y()),
                        static_cast<int>(at.z()));
}

Eigen::Vector3d centerOf(const LightVolume& volume, const Eigen::Vector3d& point) {
    const Eigen::Vector3d at = (point - volume.low) / volume.cell_m;
    return volume.low + (at.array().floor() + 0.5).matrix() * volume.cell_m;
}

/// Irradiance vector of an unoccluded lamp, summed over its area.
Eigen::Vector3d lampVector(const Lamp& lamp, const Eigen::Vector3d& at) {
    constexpr int kSteps = 100;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const double r = lamp.radius_m * std::sqrt((i + 0.5) / kSteps);
            const double angle = 2.0 * kPi * j / kSteps;
            const Eigen::Vector3d way =
                lamp.position + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0) - at;
            const double distance = way.norm();
            sum += way / distance *
                   (lamp.radiance() * lamp.area() / (kSteps * kSteps) * (way.z() / distance) /
                    (distance * distance));
        }
    }
    return sum;
}

TEST(LightVolume, LampsSendWhatTheirAreaSends) {
    SceneBuilder builder;
    builder.object("floor", {kNyuFloor, Role::Structure, {0.5F, 0.5F, 0.5F}})
        .quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
    Scene scene = builder.build();
    scene.room_bounds.extend(Eigen::Vector3d(0, 0, 2.6));
    const RayCaster rays(scene);
    LightRig rig;
    rig.lamps.push_back({{0.1, -0.2, 2.4}, 0.3, 2.0});
    const LightVolume volume = bakeLightVolume(scene, rays, rig);
    for (const Eigen::Vector3d& point :
         {Eigen::Vector3d(0.1, -0.2, 0.4), Eigen::Vector3d(1, 0.5, 0.8),
          Eigen::Vector3d(-1.4, 1, 1.2), Eigen::Vector3d(0.4, 0.3, 1.4)}) {
        const Eigen::Vector3d expected = lampVector(rig.lamps.front(), centerOf(volume, point));
        const Eigen::Vector3d found = volume.lamps[cellAt(volume, point)].cast<double>();
        EXPECT_LT((found - expected).norm(), 0.05 * expected.norm())
            << point.transpose() << ": " << found.transpose() << " and " << expected.transpose();
    }
}

/// Irradiance of a surface from everything except the lamps, by path tracing. Lamps are invisible
/// to cameras, so the mean of a camera's view is the light of all surfaces.
double irradianceByPaths(const PathTracer& tracer, const Eigen::Vector3d& at,
                         const Eigen::Vector3d& normal) {
    constexpr int kPaths = 1500;
    Random random(11);
    double sum = 0.0;
    const Eigen::Vector3d x = normal.unitOrthogonal();
    const Eigen::Vector3d y = normal.cross(x);
    for (std::uint32_t k = 0; k < kPaths; ++k) {
        const double r = std::sqrt(random.uniform());
        const double angle = random.uniform(0.0, 2.0 * kPi);
        const Eigen::Vector3d way =
            r * std::cos(angle) * x + r * std::sin(angle) * y + std::sqrt(1.0 - r * r) * normal;
        sum += tracer.radiance(at, way, 3, k).mean();
    }
    return kPi * sum / kPaths;
}

TEST(LightVolume, BouncedLightIsThatOfThePathTracerFromEachSide) {
    Scene scene = furnishedRoom();
    for (Material& material : scene.materials) material.roughness = 1.0F;
    const RayCaster rays(scene);
    const LightRig rig = makeLightRig(scene, rays);
    const LightVolume volume = bakeLightVolume(scene, rays, rig);
    const PathTracer tracer(scene, rays, balanced(rig, volume));
    double error = 0.0;
    double error_without_slope = 0.0;
    double sum = 0.0;
    for (const Eigen::Vector3d& point :
         {Eigen::Vector3d(2.0, 1.5, 1.3), Eigen::Vector3d(1.4, 0.4, 0.5),
          Eigen::Vector3d(3.6, 2.6, 1.9), Eigen::Vector3d(1.6, 2.4, 2.3)}) {
        const Eigen::Vector3d at = centerOf(volume, point);
        const std::size_t cell = cellAt(volume, point);
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {1.0, -1.0}) {
                const Eigen::Vector3d normal = side * Eigen::Vector3d::Unit(axis);
                const double expected = irradianceByPaths(tracer, at, normal);
                const double all = volume.ambient[cell].mean();
                const double facing = 1.0 + volume.slope[cell].cast<double>().dot(normal);
                error += std::abs(all * facing - expected);
                error_without_slope += std::abs(all - expected);
                sum += expected;
            }
        }
    }
    EXPECT_LT(error / sum, 0.08);
    EXPECT_GT(error_without_slope, 1.5 * error);
}

/// Relative error of the light on the boards of a shelf.
double errorInsideShelf(double cell_m) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    // Three compartments of 30 cm, open to the room in +x.
    builder.object("shelf", {39, Role::Target, {0.4F, 0.4F, 0.4F}})
        .box({0.02, 1.5, 0.5}, {0.02, 0.8, 1.0});
    for (const double y : {1.1, 1.9}) builder.box({0.2, y, 0.5}, {0.36, 0.02, 1.0});
    for (const double z : {0.05, 0.36, 0.67, 0.98}) builder.box({0.2, 1.5, z}, {0.36, 0.8, 0.02});
    Scene scene = builder.build();
    for (Material& material : scene.materials) material.roughness = 1.0F;
    const RayCaster rays(scene);
    const LightRig rig = makeLightRig(scene, rays);
    LightVolumeParams params;
    params.cell_m = cell_m;
    const LightVolume volume = bakeLightVolume(scene, rays, rig, params);
    const PathTracer tracer(scene, rays, balanced(rig, volume));
    double error = 0.0;
    double sum = 0.0;
    for (const double z : {0.2, 0.51, 0.82}) {
        const Eigen::Vector3d at(0.15, 1.5, z);
        const double expected = irradianceByPaths(tracer, at, Eigen::Vector3d::UnitX());
        const std::size_t cell = cellAt(volume, at);
        const double facing = 1.0 + volume.slope[cell].x();
        error += std::abs(volume.ambient[cell].mean() * facing - expected);
        sum += expected;
    }
    return error / sum;
}

TEST(LightVolume, InsideAShelfItIsAsDarkAsPathTraced) {
    EXPECT_LT(errorInsideShelf(LightVolumeParams{}.cell_m), 0.25);
    EXPECT_GT(errorInsideShelf(0.25), 0.4);
}

// The cells of a hall are about as wide as its columns, so which cells lie inside a column varies
// along it.
TEST(LightVolume, TheInsideOfAColumnDoesNotDarkenItsFaces) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 5, 4});
    builder.object("column").box({3.0, 2.5, 2.0}, {0.4, 0.4, 4.0}, 0.2);
    const Scene scene = builder.build();
    const RayCaster rays(scene);
    LightVolumeParams params;
    params.cell_m = 0.28;
    const LightVolume volume = bakeLightVolume(scene, rays, makeLightRig(scene, rays), params);
    const auto ambientAt = [&](double x, double z) {
        return volume.ambient[cellAt(volume, {x, 2.5, z})].mean();
    };
    for (double z = 0.5; z < 3.5; z += 0.25) {
        const float beside = std::min(ambientAt(2.3, z), ambientAt(3.7, z));
        EXPECT_GT(ambientAt(3.0, z), 0.5F * beside) << z;
    }
}

/// A house of two storeys in one box, as for a camera that can reach all of it: a gallery over most
/// of a hall, two rooms behind a wall on the gallery, and a store room without a door below.
Scene houseWithGallery() {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {8, 6, 5.4});
    const SceneBuilder::Look wall{kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}};
    builder.object("gallery", {kNyuFloor, Role::Structure, {0.5F, 0.5F, 0.5F}})
        .box({4.0, 2.4, 2.6}, {8.0, 4.8, 0.2});
    builder.object("upper wall", wall).box({4.0, 4.7, 4.05}, {8.0, 0.1, 2.7});
    builder.object("wall between", wall).box({3.0, 2.35, 4.05}, {0.1, 4.6, 2.7});
    builder.object("store wall a", wall).box({1.45, 0.6, 1.25}, {0.1, 1.2, 2.5});
    builder.object("store wall b", wall).box({0.75, 1.25, 1.25}, {1.5, 0.1, 2.5});
    return builder.build();
}

TEST(LightVolume, EachStoreyAndClosedRoomIsAboutAsBright) {
    Scene scene = houseWithGallery();
    for (Material& material : scene.materials) material.roughness = 1.0F;
    const RayCaster rays(scene);
    const LightRig rig = makeLightRig(scene, rays);
    LightVolumeParams params;
    params.cell_m = 0.15;
    const LightVolume volume = bakeLightVolume(scene, rays, rig, params);
    const PathTracer tracer(scene, rays, balanced(rig, volume));
    // Positions on the floors of the store room, the room below, the hall and both rooms above.
    const std::vector<Eigen::Vector3d> places = {
        {0.7, 0.6, 0.1}, {5.0, 2.4, 0.1}, {4.0, 5.4, 0.1}, {1.5, 2.4, 2.8}, {5.5, 2.4, 2.8}};
    std::vector<double> light;
    for (const Eigen::Vector3d& at : places) {
        const std::size_t cell = cellAt(volume, at);
        const double bounced = volume.ambient[cell].mean() * (1.0 + volume.slope[cell].z());
        const double expected =
            irradianceByPaths(tracer, centerOf(volume, at), Eigen::Vector3d::UnitZ());
        EXPECT_NEAR(bounced, expected, 0.3 * expected) << at.transpose();
        light.push_back(bounced + volume.lamps[cell].z() * rig.lampLight().mean());
    }
    std::vector<double> sorted = light;
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < light.size(); ++i) {
        EXPECT_GT(light[i], sorted[2] / 3.0) << places[i].transpose();
        EXPECT_LT(light[i], sorted[2] * 3.0) << places[i].transpose();
    }
}

TEST(LightRig, ALampWithinAColumnOrCupboardLeavesTheRoomToAnother) {
    for (const double side : {0.6, 3.2}) {
        SceneBuilder builder;
        builder.room({0, 0, 0}, {5, 5, 2.6});
        builder.object("block").box({2.5, 2.5, 1.3}, {side, side, 2.6});
        const Scene scene = builder.build();
        const RayCaster rays(scene);
        const LightRig rig = makeLightRig(scene, rays);
        for (const double x : {0.45, 4.55}) {
            for (const double y : {0.45, 4.55}) {
                const Eigen::Vector3d place(x, y, 1.0);
                EXPECT_TRUE(std::ranges::any_of(rig.lamps,
                                                [&](const Lamp& lamp) {
                                                    return (lamp.position - place).norm() < 4.5 &&
                                                           rays.sees(place, lamp.position);
                                                }))
                    << side << ": " << place.transpose();
            }
        }
    }
}

TEST(LightRig, ARoomThatIsLitGetsNoFurtherLamp) {
    const Scene scene = furnishedRoom();
    EXPECT_EQ(makeLightRig(scene, RayCaster(scene)).lamps.size(), 1U);
}

TEST(LightRig, LampsOfTheSceneAreWhereLightComesFrom) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {3, 3, 2.6});
    builder.object("pendant", {35, Role::Target, {0.8F, 0.8F, 0.8F}})
        .box({1.9, 1.2, 2.1}, {0.3, 0.3, 0.2});
    builder.object("floor lamp", {35, Role::Target, {0.8F, 0.8F, 0.8F}})
        .box({1.4, 1.5, 0.8}, {0.3, 0.3, 1.6});
    const Scene scene = builder.build();
    const LightRig rig = makeLightRig(scene, RayCaster(scene));
    ASSERT_EQ(rig.lamps.size(), 1U);
    EXPECT_NEAR(rig.lamps[0].position.x(), 1.9, 1e-6);
    EXPECT_NEAR(rig.lamps[0].position.y(), 1.2, 1e-6);
    EXPECT_LT(rig.lamps[0].position.z(), 2.0);  // below the pendant
    EXPECT_GT(rig.lamps[0].position.z(), 1.6);

    SceneBuilder without;
    without.room({0, 0, 0}, {3, 3, 2.6});
    // So close to a wall its light would pass through the wall.
    without.object("sconce", {35, Role::Target, {0.8F, 0.8F, 0.8F}})
        .box({0.6, 1.5, 1.9}, {0.2, 0.2, 0.2});
    const Scene bare = without.build();
    const LightRig middle = makeLightRig(bare, RayCaster(bare));
    EXPECT_NEAR(middle.lamps.at(0).position.x(), 1.5, 1e-6);
}

/// The first lamp of a room of 4 x 4 m with a partition at y = 2.2 m, a spotlight 20 cm in front of
/// it and, if requested, a cupboard that hangs over the middle of the room.
Lamp lampBesideWall(bool with_wall, bool with_cupboard) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 4, 2.6});
    if (with_wall) {
        builder.object("wall", {kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}})
            .box({2.0, 2.25, 1.3}, {4.0, 0.1, 2.6});
    }
    if (with_cupboard) builder.object("cupboard").box({2.0, 1.9, 2.1}, {1.2, 0.6, 1.0});
    builder.object("spotlight", {35, Role::Target, {0.8F, 0.8F, 0.8F}})
        .box({2.0, 2.0, 1.55}, {0.1, 0.1, 0.1});
    const Scene scene = builder.build();
    return makeLightRig(scene, RayCaster(scene)).lamps.at(0);
}

TEST(LightRig, RoomLampsKeepClearOfWallsAndCupboards) {
    const Lamp beside = lampBesideWall(true, false);
    EXPECT_GT(std::abs(beside.position.y() - 2.25) - 0.05, beside.radius_m);
    EXPECT_GT(beside.position.z(), 2.2);  // not below the spotlight
    const Lamp aside = lampBesideWall(true, true);
    EXPECT_LT(aside.position.y() + aside.radius_m, 1.6);  // not in the cupboard or behind the wall
    EXPECT_GT(aside.position.z(), 2.2);
    // Without obstacles the lamp is at the spotlight.
    const Lamp free = lampBesideWall(false, false);
    EXPECT_LT((free.position.head<2>() - Eigen::Vector2d(2, 2)).norm(), 1e-6);
    EXPECT_LT(free.position.z(), 1.6);
}

/// The light on a wall from a lamp whose ball the wall cuts through.
TEST(LightRig, APlaceInALampsBallIsLitByASmallerBall) {
    SceneLamp lamp;
    lamp.radius_m = 0.1;
    const Eigen::Vector3d inside(0.05, 0, 0);
    const Eigen::Vector3d outside(1, 0, 0);
    EXPECT_EQ(lamp.radiusFrom(outside), 0.1);
    EXPECT_LT(lamp.radiusFrom(inside), 0.05);
    for (const Eigen::Vector3d& place : {inside, outside}) {
        const double radius = lamp.radiusFrom(place);
        EXPECT_NEAR(lamp.radianceFrom(place) * kPi * radius * radius, lamp.intensity, 1e-12);
    }
}

}  // namespace
}  // namespace dollytrack::render::light_volume_test
