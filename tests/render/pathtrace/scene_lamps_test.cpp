#include "render/light/scene_lamps.h"

#include "render/light/light_volume.h"
#include "render/pathtrace/path_tracer.h"
#include "tests/render/lamp_room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dollytrack::render::scene_lamps_test {
namespace {

using dollytrack::test::SceneBuilder;
using fixture::lampBall;
using fixture::lampRoom;

constexpr double kPi = std::numbers::pi;

/// Looks lamps up for a surface as rendering does: interpolated between cells, one cell away from
/// the surface.
Eigen::Vector3d lampsOn(const LightVolume& volume, const Eigen::Vector3d& point,
                        const Eigen::Vector3d& normal) {
    const Eigen::Vector3d at = (point + volume.cell_m * normal - volume.low) / volume.cell_m -
                               Eigen::Vector3d::Constant(0.5);
    const Eigen::Vector3d low = at.array().floor();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        std::array<int, 3> cell{};
        for (int axis = 0; axis < 3; ++axis) {
            const int up = corner >> axis & 1;
            const double part = at[axis] - low[axis];
            weight *= up == 1 ? part : 1.0 - part;
            cell[axis] = std::clamp(static_cast<int>(low[axis]) + up, 0, volume.cells[axis] - 1);
        }
        sum += weight * volume.lamps[volume.index(cell[0], cell[1], cell[2])].cast<double>();
    }
    return sum;
}

LightRig ownAlone(const Scene& scene, const RayCaster& rays, double share = 1.0) {
    ResolvedLight light;
    light.own_lamps = static_cast<float>(share);
    LightRig rig = makeLightRig(scene, rays, {}, light);
    rig.lamps.clear();
    rig.sky_strength = 0.0;
    return rig;
}

TEST(SceneLamps, AreWhereTheShadesAre) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 3, 2.6});
    const auto lamp = [&](const char* name) -> SceneBuilder& {
        return builder.object(name, {kNyuLamp, Role::Target, {0.8F, 0.8F, 0.8F}});
    };
    lamp("hangs in the middle").box({1.6, 1.5, 2.4}, {0.3, 0.3, 0.4});
    lamp("bulb of that").box({1.6, 1.5, 2.35}, {0.06, 0.06, 0.1});
    lamp("stands").box({0.5, 0.5, 0.75}, {0.4, 0.4, 1.5});
    lamp("bulb").box({0.5, 0.5, 1.2}, {0.05, 0.05, 0.1});
    lamp("sconce").box({4.0, 0.1, 1.7}, {0.2, 0.3, 0.3});  // 0.05 m into the wall
    lamp("hangs long").box({5.5, 2.5, 2.2}, {0.2, 0.2, 0.8});
    lamp("lies on the ceiling").box({3.0, 2.5, 2.5}, {0.2, 0.1, 0.1});
    lamp("outside").box({9, 0.5, 1}, {0.2, 0.2, 0.2});
    Scene scene = builder.build();
    scene.room_bounds = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(6, 3, 2.6)};
    const RayCaster rays(scene);
    const LightRig rig = makeLightRig(scene, rays);
    ASSERT_EQ(rig.scene_lamps.size(), 4U);
    EXPECT_NEAR(rig.scene_lamps[3].position.z(), 2.5, 0.02);
    const SceneLamp& stands = rig.scene_lamps[0];
    EXPECT_LT((stands.position - Eigen::Vector3d(0.5, 0.5, 1.25)).norm(), 1e-6);
    EXPECT_NEAR(stands.radius_m, 0.12, 1e-6);
    EXPECT_LT((rig.scene_lamps[1].position - Eigen::Vector3d(5.5, 2.5, 2.2 - 0.8 / 3)).norm(),
              1e-6);
    const SceneLamp& sconce = rig.scene_lamps[2];
    EXPECT_NEAR(sconce.position.z(), 1.7, 1e-6);
    const double back = sconce.shade.center.y() - sconce.shade.half_size.y();
    EXPECT_GT(back, 0.0);  // not into the wall
    EXPECT_LT(back, 0.01);
    for (const SceneLamp& one : rig.scene_lamps) {
        EXPECT_TRUE(one.shade.contains(one.position));
        EXPECT_EQ(one.intensity, kSceneLampIntensity);
    }
    ResolvedLight none;
    none.own_lamps = 0.0F;
    EXPECT_TRUE(makeLightRig(scene, rays, {}, none).scene_lamps.empty());
    ResolvedLight twice;
    twice.own_lamps = 2.0F;
    EXPECT_NEAR(makeLightRig(scene, rays, {}, twice).scene_lamps[0].intensity,
                2 * kSceneLampIntensity, 1e-9);
}

// The distance that a ray travels until it leaves the lamp's box: nothing inside the box casts
// shadows outside.
TEST(SceneLamps, NothingInTheShadeCastsShadows) {
    SceneLamp lamp;
    lamp.shade = {{0, 0, 0}, {0.2, 0.1, 0.3}, 0.5 * kPi};  // turned: 0.1 along x
    EXPECT_NEAR(lamp.shadowedFor({1, 0, 0}, {-1, 0, 0}, 1.0), 0.9, 1e-12);
    EXPECT_NEAR(lamp.shadowedFor({0, 1, 0}, {0, -1, 0}, 1.0), 0.8, 1e-12);
    EXPECT_NEAR(lamp.shadowedFor({0, 0.1, -1}, {0, 0, 1}, 1.0), 0.7, 1e-12);
    EXPECT_EQ(lamp.shadowedFor({0.05, 0, 0.2}, {0, 0, -1}, 0.2), 0.0);
    EXPECT_EQ(lamp.shadowedFor({1, 0.5, 0}, {-1, 0, 0}, 1.0), 1.0);  // passes by
}

// Light on wall, table and ceiling falls with the inverse square, on the grid and by path tracing
// alike.
TEST(SceneLamps, LightTheWallBesideThem) {
    const Scene scene = lampRoom(0.5F);
    const RayCaster rays(scene);
    const LightVolume volume = bakeLightVolume(scene, rays, ownAlone(scene, rays));
    // Path tracing without indirect light: one bounce.
    PathTracerParams params;
    params.max_bounces = 0;
    const LightRig rig = ownAlone(scene, rays);
    const PathTracer tracer(scene, rays, rig, params);
    params.sample_lights = false;
    params.max_bounces = 1;
    const PathTracer by_chance(scene, rays, rig, params);
    struct Place {
        Eigen::Vector3d at, normal;
        double off;  // tolerance for the grid
    };
    for (const Place& place :
         {Place{{0, 1.5, 1.1}, {1, 0, 0}, 0.12}, Place{{0, 1.8, 1.2}, {1, 0, 0}, 0.12},
          Place{{0, 1.1, 1.5}, {1, 0, 0}, 0.12}, Place{{0, 2.4, 1.6}, {1, 0, 0}, 0.12},
          Place{{0.75, 1.5, 0.7}, {0, 0, 1}, 0.2}, Place{{0.5, 2.0, 0.7}, {0, 0, 1}, 0.2},
          Place{{0.4, 1.5, 2.6}, {0, 0, -1}, 0.12}}) {
        const Eigen::Vector3d way = lampBall() - place.at;
        const double expected =
            kSceneLampIntensity * way.normalized().dot(place.normal) / way.squaredNorm();
        const double found = lampsOn(volume, place.at, place.normal).dot(place.normal);
        EXPECT_NEAR(found, expected, place.off * expected) << place.at.transpose();
        // Half of it is reflected, as by a rough surface that is seen straight on.
        const Eigen::Vector3d from =
            place.at + 0.3 * place.normal + 0.2 * place.normal.unitOrthogonal();
        const auto traced = [&](const PathTracer& by, int paths) {
            double sum = 0.0;
            for (int k = 0; k < paths; ++k) {
                sum += by.radiance(from, (place.at - from).normalized(), 0,
                                   static_cast<std::uint32_t>(k))
                           .y();
            }
            return sum / paths * kPi / (0.5 * rig.sceneLampLight().y());
        };
        const double sampled = traced(tracer, 400);
        EXPECT_NEAR(sampled, expected, 0.15 * expected) << place.at.transpose();
        EXPECT_NEAR(traced(by_chance, 60'000), sampled, 0.1 * sampled) << place.at.transpose();
    }
}

// The lamp's box reaches to the wall, and beyond it where the wall is thin.
TEST(SceneLamps, DoNotLightTheNextRoom) {
    const Scene scene = lampRoom(0.8F, true);
    const RayCaster rays(scene);
    LightRig rig = ownAlone(scene, rays);
    ASSERT_EQ(rig.scene_lamps.size(), 1U);
    EXPECT_GT(rig.scene_lamps[0].shade.center.x() - rig.scene_lamps[0].shade.half_size.x(), 0.0);
    const auto ambientAt = [&](const LightVolume& volume, double x) {
        const Eigen::Vector3d at = (Eigen::Vector3d(x, 1.5, 1.3) - volume.low) / volume.cell_m;
        return volume
            .ambient[volume.index(static_cast<int>(at.x()), static_cast<int>(at.y()),
                                  static_cast<int>(at.z()))]
            .mean();
    };
    const LightVolume volume = bakeLightVolume(scene, rays, rig);
    const PathTracer tracer(scene, rays, rig);
    const auto seenOnWall = [&](double from, double to) {
        double sum = 0.0;
        for (std::uint32_t k = 0; k < 200; ++k) {
            sum +=
                tracer
                    .radiance({from, 1.4, 1.3}, Eigen::Vector3d(to - from, 0, 0).normalized(), 0, k)
                    .mean();
        }
        return sum / 200;
    };
    EXPECT_GT(ambientAt(volume, 1.5), 0.005);
    EXPECT_LT(ambientAt(volume, -1.5), 0.01 * ambientAt(volume, 1.5));
    EXPECT_GT(seenOnWall(1.5, 0.0), 0.02);
    EXPECT_EQ(seenOnWall(-1.5, -0.1), 0.0);
    EXPECT_EQ(seenOnWall(-1.5, -3.1), 0.0);
}

}  // namespace
}  // namespace dollytrack::render::scene_lamps_test
