#include "render/light/sun_rays.h"

#include "engine/core/random.h"
#include "render/light/light_volume.h"
#include "render/pathtrace/path_tracer.h"
#include "tests/render/sunny_room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dollytrack::render::sun_rays_test {
namespace {

using fixture::Hole;
using fixture::sunAlone;
using fixture::sunnyRoom;

double shareAt(const Scene& scene, const Eigen::Vector3d& at) {
    const RayCaster rays(scene);
    const TracedSurface surface(scene, nullptr);
    const LightRig rig = sunAlone(scene);
    return SunRays(scene, rays, surface, rig.sun).share(at, rig.sun.way);
}

TEST(SunRays, PassWindowsAndGlassButNothingElse) {
    const Eigen::Vector3d lit(1.5, 1.5, 1e-3);
    const Eigen::Vector3d dark(2.5, 1.5, 1e-3);
    EXPECT_EQ(shareAt(sunnyRoom(Hole::Window), lit), 1.0);
    EXPECT_EQ(shareAt(sunnyRoom(Hole::Window), dark), 0.0);
    EXPECT_EQ(shareAt(sunnyRoom(Hole::Shutter), lit), 0.0);
    const double slant = std::sqrt(0.5);
    EXPECT_NEAR(shareAt(sunnyRoom(Hole::Pane), lit), 0.75 * (1.0 - sheetReflectance(slant)), 1e-6);
}

// The file also has a sky dome and a neighbour's house, but only parts of the building cast
// shadows.
TEST(SunRays, WhatLiesOutsideCastsNoShadow) {
    const Eigen::Vector3d lit(1.5, 1.5, 1e-3);
    for (const double away : {0.2, 3.0}) {
        Scene scene = sunnyRoom(Hole::Window);
        const Eigen::AlignedBox3d room = scene.room_bounds;
        const Object& hole = scene.objects.back();
        // A copy of the quad in the hole, outside in front of it, as a separate object.
        Object board = hole;
        board.id = hole.id + 1;
        board.nyu40 = kNyuOtherProp;
        board.first_vertex = static_cast<std::uint32_t>(scene.positions.size());
        board.first_triangle = static_cast<std::uint32_t>(scene.triangles.size());
        for (std::uint32_t i = 0; i < hole.vertex_count; ++i) {
            const std::uint32_t from = hole.first_vertex + i;
            const auto aside = static_cast<float>(away);
            scene.positions.push_back(scene.positions[from] + Eigen::Vector3f(-aside, 0, aside));
            scene.normals.push_back(scene.normals[from]);
            scene.uvs.push_back(scene.uvs[from]);
        }
        for (std::uint32_t t = 0; t < hole.triangle_count; ++t) {
            Triangle triangle = scene.triangles[hole.first_triangle + t];
            for (std::uint32_t& corner : triangle) {
                corner += board.first_vertex - hole.first_vertex;
            }
            scene.triangles.push_back(triangle);
            scene.triangle_material.push_back(scene.triangle_material[hole.first_triangle]);
        }
        scene.objects.push_back(board);
        scene.room_bounds = room;
        EXPECT_EQ(shareAt(scene, lit), away < 0.5 ? 0.0 : 1.0) << away;
    }
}

// The sunlit floor reflects its share of the sunlight.
TEST(SunRays, PathsSeeTheSunlitFloor) {
    const Scene scene = sunnyRoom(Hole::Window);
    const RayCaster rays(scene);
    PathTracerParams params;
    params.max_bounces = 1;
    const PathTracer tracer(scene, rays, sunAlone(scene), params);
    const auto seenAt = [&](double x) {
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        const Eigen::Vector3d eye(2.0, 1.5, 2.5);
        const Eigen::Vector3d way = (Eigen::Vector3d(x, 1.5, 0.0) - eye).normalized();
        for (std::uint32_t k = 0; k < 256; ++k) sum += tracer.radiance(eye, way, 1, k);
        return Eigen::Vector3f(sum / 256.0F);
    };
    const Eigen::Vector3f lit = seenAt(1.5);
    const double expected = 0.5 * 4.0 * std::sqrt(0.5) / std::numbers::pi;
    EXPECT_NEAR(lit[0], expected, 0.05 * expected);
    EXPECT_NEAR(lit[1] / lit[0], 0.75, 0.02);
    EXPECT_EQ(seenAt(2.5).maxCoeff(), 0.0F);
}

/// Irradiance of a surface from all directions, by path tracing.
double irradianceByPaths(const PathTracer& tracer, const Eigen::Vector3d& at,
                         const Eigen::Vector3d& normal) {
    constexpr int kPaths = 3000;
    Random random(5);
    const Eigen::Vector3d x = normal.unitOrthogonal();
    const Eigen::Vector3d y = normal.cross(x);
    double sum = 0.0;
    for (std::uint32_t k = 0; k < kPaths; ++k) {
        const double r = std::sqrt(random.uniform());
        const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
        const Eigen::Vector3d way =
            r * std::cos(angle) * x + r * std::sin(angle) * y + std::sqrt(1.0 - r * r) * normal;
        sum += tracer.radiance(at, way, 3, k).mean();
    }
    return std::numbers::pi * sum / kPaths;
}

TEST(SunRays, TheRoomGetsWhatTheSunlitFloorThrowsBack) {
    const Scene scene = sunnyRoom(Hole::Window);
    const RayCaster rays(scene);
    const LightRig rig = sunAlone(scene);
    const LightVolume volume = bakeLightVolume(scene, rays, rig);
    const PathTracer tracer(scene, rays, balanced(rig, volume));
    double error = 0.0;
    double sum = 0.0;
    for (const Eigen::Vector3d& point :
         {Eigen::Vector3d(3.0, 1.5, 1.3), Eigen::Vector3d(2.2, 0.6, 1.9),
          Eigen::Vector3d(1.5, 2.4, 2.2), Eigen::Vector3d(3.5, 2.5, 0.5)}) {
        const Eigen::Vector3d in_cell = (point - volume.low) / volume.cell_m;
        const std::size_t cell =
            volume.index(static_cast<int>(in_cell.x()), static_cast<int>(in_cell.y()),
                         static_cast<int>(in_cell.z()));
        const Eigen::Vector3d at =
            volume.low + (in_cell.array().floor() + 0.5).matrix() * volume.cell_m;
        double around = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {1.0, -1.0}) {
                around += irradianceByPaths(tracer, at, side * Eigen::Vector3d::Unit(axis)) / 6.0;
            }
        }
        error += std::abs(volume.ambient[cell].mean() - around);
        sum += around;
    }
    EXPECT_GT(sum, 0.0);
    EXPECT_LT(error / sum, 0.15);
}

// No light enters a closed room; this test would show a leak.
TEST(SunRays, AClosedRoomStaysDark) {
    const Scene scene = sunnyRoom(Hole::Shutter);
    const RayCaster rays(scene);
    const LightRig rig = sunAlone(scene);
    const LightVolume volume = bakeLightVolume(scene, rays, rig);
    for (std::size_t i = 0; i < volume.ambient.size(); ++i) {
        const auto x = static_cast<int>(i % static_cast<std::size_t>(volume.cells[0]));
        const double at = volume.low.x() + (x + 0.5) * volume.cell_m;
        if (at > 0.5 && at < 3.5) {
            ASSERT_EQ(volume.ambient[i].maxCoeff(), 0.0F) << i;
        }
    }
    const PathTracer tracer(scene, rays, rig);
    for (std::uint32_t k = 0; k < 200; ++k) {
        const Eigen::Vector3d way(std::cos(0.1 * k), std::sin(0.1 * k), 0.01 * k - 1.0);
        EXPECT_EQ(tracer.radiance({2.0, 1.5, 1.3}, way.normalized(), 1, k).maxCoeff(), 0.0F);
    }
}

}  // namespace
}  // namespace dollytrack::render::sun_rays_test
