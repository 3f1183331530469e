#include "render/pathtrace/path_tracer.h"

#include "engine/core/random.h"
#include "engine/jobs/parallel.h"
#include "render/materials/surface_brdf.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

namespace dollytrack::render::path_tracer_test {
namespace {

using dollytrack::test::SceneBuilder;

constexpr double kPi = std::numbers::pi;

LightRig darkness() {
    LightRig rig;
    rig.lamp_color.setOnes();
    rig.sky_color.setOnes();
    rig.sky_strength = 0.0;
    return rig;
}

/// A mean and its standard error.
struct Measured {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    double error = 0.0;  // of the mean of the channels
};

template <class Sample>
Measured measure(int count, Sample&& sample) {
    Measured result;
    double squares = 0.0;
    double plain = 0.0;
    for (int k = 0; k < count; ++k) {
        const Eigen::Vector3d value = sample(static_cast<std::uint32_t>(k));
        result.mean += value;
        plain += value.mean();
        squares += value.mean() * value.mean();
    }
    result.mean /= count;
    plain /= count;
    result.error = std::sqrt(std::max(0.0, squares / count - plain * plain) / count);
    return result;
}

Measured trace(const PathTracer& tracer, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               int count) {
    const Eigen::Vector3d way = (to - from).normalized();
    return measure(count, [&](std::uint32_t k) -> Eigen::Vector3d {
        return tracer.radiance(from, way, 0, k).cast<double>();
    });
}

Scene ball(const Eigen::Vector3f& color, int rings) {
    SceneBuilder builder;
    builder.object("ball", {kNyuOtherProp, Role::Target, color});
    const auto at = [&](int i, int j) {
        const double polar = kPi * i / rings;
        const double around = 2.0 * kPi * j / (2 * rings);
        return Eigen::Vector3d(std::sin(polar) * std::cos(around),
                               std::sin(polar) * std::sin(around), std::cos(polar));
    };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < 2 * rings; ++j) {
            builder.quad(at(i, j), at(i + 1, j) - at(i, j), at(i, j + 1) - at(i, j));
        }
    }
    return builder.build();
}

// White furnace test: in uniform light from all directions a ball that absorbs nothing is
// invisible.
TEST(PathTracer, AWhiteBallVanishesInEvenLight) {
    LightRig rig = darkness();
    rig.sky_strength = 1.0;
    rig.ground_share = 1.0;
    for (const double roughness : {0.2, 0.5, 1.0}) {
        for (const double metallic : {0.0, 1.0}) {
            const auto meanOf = [&](float color) {
                Scene scene = ball(Eigen::Vector3f::Constant(color), 24);
                scene.materials[0].roughness = static_cast<float>(roughness);
                scene.materials[0].metallic = static_cast<float>(metallic);
                const RayCaster rays(scene);
                const PathTracer tracer(scene, rays, rig);
                double sum = 0.0;
                for (int k = 0; k < 9; ++k) {  // across the ball, almost to its rim
                    sum += trace(tracer, {0.1 * k, -3, 0.05}, {0.1 * k, 0, 0.05}, 1024).mean.mean();
                }
                return sum / 9.0;
            };
            EXPECT_NEAR(meanOf(1.0F), 1.0, 0.01) << roughness << ' ' << metallic;
            EXPECT_LT(meanOf(0.9F), 0.96) << roughness << ' ' << metallic;
        }
    }
}

/// Light of a round lamp that a horizontal surface at the origin reflects along `out`, summed over
/// the lamp's area; `seen` tells which points of the lamp the surface sees.
template <class Seen>
double lampSum(const Lamp& lamp, const SurfaceBrdf* brdf, Seen&& seen) {
    constexpr int kRings = 200;
    double sum = 0.0;
    for (int i = 0; i < kRings; ++i) {
        for (int j = 0; j < 2 * kRings; ++j) {
            const double r = lamp.radius_m * (i + 0.5) / kRings;
            const double angle = 2.0 * kPi * (j + 0.5) / (2 * kRings);
            const Eigen::Vector3d at =
                lamp.position + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0.0);
            if (!seen(at)) continue;
            const double area = r * (lamp.radius_m / kRings) * (2.0 * kPi / (2 * kRings));
            const Eigen::Vector3d way = at.normalized();
            const double value = brdf ? brdf->value(way).mean() : 1.0;
            sum += value * lamp.radiance() * way.z() * way.z() * area / at.squaredNorm();
        }
    }
    return sum;
}

TEST(PathTracer, APlaneUnderALampIsAsBrightAsTheIntegralSays) {
    SceneBuilder builder;
    builder.object("floor", {kNyuFloor, Role::Structure, {0.6F, 0.6F, 0.6F}})
        .quad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
    Scene scene = builder.build();
    scene.materials[0].roughness = 0.7F;
    const RayCaster rays(scene);
    LightRig rig = darkness();
    rig.lamps.push_back({{0.0, 0.0, 2.0}, 0.5, 3.0});

    // Straight below a Lambertian disc the irradiance has a closed form.
    const Lamp& lamp = rig.lamps.front();
    const auto all = [](const Eigen::Vector3d&) { return true; };
    EXPECT_NEAR(lampSum(lamp, nullptr, all), kPi * lamp.radiance() * 0.25 / (0.25 + 4.0), 1e-4);
    EXPECT_NEAR(kPi * lamp.radiance() * 0.25 / (0.25 + 1.0), 3.0, 1e-9);  // at 1 m: its intensity

    for (const Eigen::Vector3d& place :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-2, 3, 0)}) {
        const Eigen::Vector3d eye = place + Eigen::Vector3d(-0.6, 0.1, 0.8);
        const SurfaceBrdf brdf(scene.materials[0].base_color, 0.0, 0.7, (eye - place).normalized());
        Lamp moved = lamp;
        moved.position -= place;
        const double expected = lampSum(moved, &brdf, all);
        for (const bool sample_lights : {true, false}) {
            PathTracerParams params;
            params.sample_lights = sample_lights;
            const PathTracer tracer(scene, rays, rig, params);
            const Measured found = trace(tracer, eye, place, sample_lights ? 4096 : 262144);
            EXPECT_NEAR(found.mean.mean(), expected, 0.005 * expected + 4.0 * found.error)
                << place.transpose() << ' ' << sample_lights;
        }
    }
}

TEST(PathTracer, WhatStandsBeforeHalfTheLampTakesHalfItsLight) {
    SceneBuilder builder;
    builder.object("floor", {kNyuFloor, Role::Structure, {0.6F, 0.6F, 0.6F}})
        .quad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
    // Black, so that it reflects nothing; below the lamp's shade.
    builder.object("board", {kNyuOtherProp, Role::Target, {0, 0, 0}})
        .quad({0, -2, 1}, {2, 0, 0}, {0, 4, 0});
    const Scene scene = builder.build();
    const RayCaster rays(scene);
    LightRig rig = darkness();
    rig.lamps.push_back({{0.0, 0.0, 2.0}, 0.5, 3.0});
    const PathTracer tracer(scene, rays, rig);
    const Eigen::Vector3d eye(-0.6, 0.1, 0.8);
    const SurfaceBrdf brdf(scene.materials[0].base_color, 0.0, scene.materials[0].roughness,
                           eye.normalized());
    const double expected =
        lampSum(rig.lamps.front(), &brdf, [](const Eigen::Vector3d& at) { return at.x() < 0.0; });
    EXPECT_NEAR(trace(tracer, eye, {0, 0, 0}, 8192).mean.mean(), expected, 0.015 * expected);
}

/// A closed box with coloured sides, a luminous panel, a lamp, a window and a block inside.
Scene cornell(const Eigen::Vector3f& side = {0.7F, 0.1F, 0.1F}) {
    SceneBuilder builder;
    const auto structure = [](const Eigen::Vector3f& color) {
        return SceneBuilder::Look{kNyuWall, Role::Structure, color};
    };
    const Eigen::Vector3f white(0.7F, 0.7F, 0.7F);
    builder.object("floor", structure(white)).quad({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
    builder.object("ceiling", structure(white)).quad({0, 0, 2}, {0, 2, 0}, {2, 0, 0});
    builder.object("back", structure(white)).quad({0, 2, 0}, {2, 0, 0}, {0, 0, 2});
    builder.object("front", structure(white)).quad({0, 0, 0}, {0, 0, 2}, {2, 0, 0});
    builder.object("left", structure(side)).quad({0, 0, 0}, {0, 2, 0}, {0, 0, 2});
    builder.object("right", structure({0.1F, 0.6F, 0.1F})).quad({2, 0, 0}, {0, 0, 2}, {0, 2, 0});
    builder.object("panel").quad({0.7, 0.7, 1.98}, {0, 0.6, 0}, {0.6, 0, 0});
    builder.object("block", {kNyuOtherProp, Role::Target, {0.8F, 0.8F, 0.5F}})
        .box({1.3, 1.3, 0.4}, {0.6, 0.6, 0.8}, 0.4);
    builder.object("window", {kNyuWindow, Role::Structure, {0.5F, 0.5F, 0.5F}})
        .quad({1.99, 0.6, 0.8}, {0, 0, 0.8}, {0, 0.8, 0});
    Scene scene = builder.build();
    scene.materials[6].emission = {3.0F, 2.5F, 2.0F};
    scene.materials[7].roughness = 0.4F;
    scene.materials[7].metallic = 0.5F;
    return scene;
}

LightRig cornellLight() {
    LightRig rig;
    rig.lamps.push_back({{0.5, 0.4, 1.8}, 0.15, 0.6});
    return rig;
}

/// The simplest possible path tracer: uniformly random directions of the hemisphere, no importance
/// sampling, no weights, a fixed number of bounces.
class PlainTracer {
  public:
    PlainTracer(const Scene& scene, const RayCaster& rays, const LightRig& rig)
        : scene_(scene), rays_(rays), rig_(rig) {}

    Eigen::Vector3d radiance(Eigen::Vector3d from, Eigen::Vector3d way, Random& random) const {
        Eigen::Vector3d light = Eigen::Vector3d::Zero();
        Eigen::Vector3d carried = Eigen::Vector3d::Ones();
        for (int bounce = 0; bounce < 24; ++bounce) {
            const RayHit hit = rays_.cast(from, way);
            if (hit.object_id == 0) break;  // the box is closed
            if (bounce > 0) {
                for (const Lamp& lamp : rig_.lamps) {
                    const double t = (lamp.position.z() - from.z()) / way.z();
                    const Eigen::Vector3d at = from + t * way;
                    if (way.z() <= 0.0 || t <= 0.0 || std::max(t - kLampShade, 0.0) >= hit.distance)
                        continue;
                    if ((at - lamp.position).norm() > lamp.radius_m) continue;
                    light += carried.cwiseProduct(rig_.lamp_color.cast<double>()) * lamp.radiance();
                }
            }
            const bool window = scene_.object(hit.object_id).nyu40 == kNyuWindow;
            if (window && bounce > 0) {
                light += carried.cwiseProduct(rig_.skyRadiance(way).cast<double>());
                break;
            }
            const Material& material = scene_.materials[scene_.triangle_material[hit.triangle]];
            light += carried.cwiseProduct(material.emission.cast<double>());
            const Triangle& t = scene_.triangles[hit.triangle];
            const Eigen::Vector3f a = scene_.positions[t[0]];
            Eigen::Vector3d normal = (scene_.positions[t[1]] - a)
                                         .cross(scene_.positions[t[2]] - a)
                                         .normalized()
                                         .cast<double>();
            if (normal.dot(way) > 0.0) normal = -normal;
            const Eigen::Vector3d x = normal.unitOrthogonal();
            const Eigen::Vector3d y = normal.cross(x);
            const SurfaceBrdf brdf(material.base_color, material.metallic, material.roughness,
                                   {-way.dot(x), -way.dot(y), -way.dot(normal)});
            const double z = random.uniform();
            const double angle = random.uniform(0.0, 2.0 * kPi);
            const double ring = std::sqrt(1.0 - z * z);
            const Eigen::Vector3d in(ring * std::cos(angle), ring * std::sin(angle), z);
            from += way * hit.distance + 1e-5 * normal;
            carried = carried.cwiseProduct(brdf.value(in).cast<double>()) * (z * 2.0 * kPi);
            way = in.x() * x + in.y() * y + in.z() * normal;
        }
        return light;
    }

  private:
    const Scene& scene_;
    const RayCaster& rays_;
    const LightRig& rig_;
};

TEST(PathTracer, AgreesWithAPlainOneInABox) {
    const Scene scene = cornell();
    const RayCaster rays(scene);
    const LightRig rig = cornellLight();
    const PlainTracer plain(scene, rays, rig);
    const PathTracer tracer(scene, rays, rig);
    PathTracerParams by_chance;
    by_chance.sample_lights = false;
    const PathTracer unsampled(scene, rays, rig, by_chance);
    const Eigen::Vector3d eye(1.0, 0.1, 1.0);
    for (const Eigen::Vector3d& target :
         {Eigen::Vector3d(0.6, 1.2, 0.0), Eigen::Vector3d(0.0, 1.3, 0.9),
          Eigen::Vector3d(1.2, 1.0, 0.8), Eigen::Vector3d(1.0, 1.2, 2.0)}) {
        const Eigen::Vector3d way = (target - eye).normalized();
        std::vector<Measured> parts(64);
        parallelFor(parts.size(), [&](std::size_t part) {
            Random random(7, part);
            parts[part] =
                measure(3000, [&](std::uint32_t) { return plain.radiance(eye, way, random); });
        });
        Measured expected;
        for (const Measured& part : parts) {
            expected.mean += part.mean / static_cast<double>(parts.size());
            expected.error += part.error * part.error;
        }
        expected.error = std::sqrt(expected.error) / static_cast<double>(parts.size());
        for (const PathTracer* one : {&tracer, &unsampled}) {
            const Measured found = trace(*one, eye, target, one == &tracer ? 8192 : 65536);
            const double error = std::hypot(expected.error, found.error);
            EXPECT_LT(error, 0.03 * expected.mean.mean());
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(found.mean[c], expected.mean[c], 4.0 * error + 0.002 * expected.mean[c])
                    << target.transpose() << " channel " << c;
            }
        }
    }
    // The comparison would detect another colour of the red wall.
    const Scene other = cornell({0.7F, 0.7F, 0.1F});
    const RayCaster other_rays(other);
    const PathTracer wrong(other, other_rays, rig);
    const double right_green = trace(tracer, eye, {0.6, 1.2, 0.0}, 8192).mean[1];
    EXPECT_GT(trace(wrong, eye, {0.6, 1.2, 0.0}, 8192).mean[1], 1.02 * right_green);
}

View viewOf(int width, int height) {
    CameraParams camera;
    camera.width_px = width;
    camera.height_px = height;
    return makeView(camera, lookAt({1.0, 0.1, 1.0}, {1.0, 1.5, 0.8}));
}

TEST(PathTracer, RepeatsToTheLastBitInAnyNumberOfStepsAndThreads) {
    const Scene scene = cornell();
    const RayCaster rays(scene);
    const PathTracer tracer(scene, rays, cornellLight());
    const View view = viewOf(32, 24);
    const auto bytes = [&](std::initializer_list<int> steps, int threads) {
        setThreadCount(threads);
        LayeredImage image;
        for (const int samples : steps) EXPECT_TRUE(tracer.add(view, samples, image));
        setThreadCount(0);
        return image.sets;
    };
    const auto expected = bytes({8}, 1);
    EXPECT_EQ(bytes({8}, 2), expected);
    EXPECT_EQ(bytes({3, 5}, 2), expected);
    EXPECT_NE(bytes({7}, 1), expected);

    PathTracerParams params;
    params.seed = 2;
    const PathTracer reseeded(scene, rays, cornellLight(), params);
    LayeredImage image;
    ASSERT_TRUE(reseeded.add(view, 8, image));
    EXPECT_NE(image.sets, expected);
}

TEST(PathTracer, StopsWhenCancelledAndLeavesThePictureAsItWas) {
    const Scene scene = cornell();
    const RayCaster rays(scene);
    const PathTracer tracer(scene, rays, cornellLight());
    LayeredImage image;
    ASSERT_TRUE(tracer.add(viewOf(8, 6), 2, image));
    const auto before = image.sets;
    const auto flag = std::make_shared<std::atomic<bool>>(true);
    const Status status = tracer.add(viewOf(8, 6), 1 << 20, image, JobContext(flag, {}));
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::Cancelled);
    EXPECT_EQ(image.sets, before);
    EXPECT_EQ(image.samples, 2);
}

/// A luminous wall behind a sheet across the view.
Scene behindSheet(float opacity, const Eigen::Vector3f& color) {
    SceneBuilder builder;
    builder.object("wall").quad({4, -20, -20}, {0, 40, 0}, {0, 0, 40});
    builder.object("sheet", {kNyuOtherProp, Role::Target, color})
        .quad({2, -20, -20}, {0, 40, 0}, {0, 0, 40});
    Scene scene = builder.build();
    scene.materials[0].emission = {1.0F, 1.0F, 1.0F};
    scene.materials[0].base_color.setZero();
    scene.materials[1].opacity = opacity;
    return scene;
}

TEST(PathTracer, GlassLetsThroughWhatItDoesNotReflect) {
    const auto seen = [](const Scene& scene) {
        const RayCaster rays(scene);
        const PathTracer tracer(scene, rays, darkness());
        return trace(tracer, {0, 0, 0}, {1, 0, 0}, 16384).mean.mean();
    };
    const double thrown = 2.0 * 0.04 / 1.04;  // both faces, straight on
    EXPECT_NEAR(seen(behindSheet(0.0F, {1, 1, 1})), 1.0 - thrown, 0.004);
    // Tinted glass: a part of it is a surface, here black and unlit from this side.
    EXPECT_NEAR(seen(behindSheet(0.4F, {0, 0, 0})), (1.0 - thrown) * 0.6, 0.008);
    EXPECT_LT(seen(behindSheet(1.0F, {0, 0, 0})), 1e-3);
}

TEST(PathTracer, LampsShineThroughGlassAndHoles) {
    const auto floorUnder = [](float opacity, const Texture* texture) {
        SceneBuilder builder;
        builder.object("floor", {kNyuFloor, Role::Structure, {0.6F, 0.6F, 0.6F}})
            .quad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
        if (opacity > 0.0F) {
            builder.object("sheet", {kNyuOtherProp, Role::Target, {0, 0, 0}})
                .quad({-50, -50, 1}, {100, 0, 0}, {0, 100, 0});
        }
        Scene scene = builder.build();
        if (opacity > 0.0F) scene.materials[1].opacity = opacity;
        if (texture != nullptr) {
            scene.textures.push_back(*texture);
            scene.materials[1].texture = 0;
        }
        const RayCaster rays(scene);
        LightRig rig = darkness();
        rig.lamps.push_back({{0.0, 0.0, 2.5}, 0.2, 3.0});
        const PathTracer tracer(scene, rays, rig);
        return trace(tracer, {-0.3, 0, 0.4}, {0, 0, 0}, 4096).mean.mean();
    };
    const double open = floorUnder(0.0F, nullptr);
    // The glass returns a little light: less than it reflects.
    EXPECT_NEAR(floorUnder(0.3F, nullptr) / open, (1.0 - 2.0 * 0.04 / 1.04) * 0.7, 0.03);
    Texture holes;
    holes.width = holes.height = 1;
    holes.rgba = {255, 255, 255, 0};
    EXPECT_NEAR(floorUnder(1.0F, &holes) / open, 1.0, 0.01);
    holes.rgba[3] = 255;
    EXPECT_LT(floorUnder(1.0F, &holes) / open, 0.01);
}

// Texels are placed as in OpenGL and decoded as sRGB.
TEST(PathTracer, ReadsTextures) {
    SceneBuilder builder;
    builder.object("wall").quad({2, -1, -1}, {0, 2, 0}, {0, 0, 2});  // u to +y, v upwards
    Scene scene = builder.build();
    Texture texture;
    texture.width = texture.height = 2;
    texture.rgba = {255, 0, 0,   255, 0,   255, 0,   255,  // the upper row
                    0,   0, 255, 255, 188, 188, 188, 255};
    scene.textures.push_back(texture);
    scene.materials[0].texture = 0;
    scene.materials[0].base_color.setOnes();
    scene.materials[0].roughness = 1.0F;
    const RayCaster rays(scene);
    const TracedSurface surface(scene, nullptr);
    const auto at = [&](double y, double z) {
        const Eigen::Vector3d way = Eigen::Vector3d(2, y, z).normalized();
        const RayHit hit = rays.cast({0, 0, 0}, way);
        EXPECT_EQ(hit.object_id, 1);
        return surface.at({0, 0, 0}, way, hit).base_color;
    };
    EXPECT_LT((at(-0.5, 0.5) - Eigen::Vector3f(1, 0, 0)).norm(), 1e-3F);
    EXPECT_LT((at(0.5, 0.5) - Eigen::Vector3f(0, 1, 0)).norm(), 1e-3F);
    EXPECT_LT((at(-0.5, -0.5) - Eigen::Vector3f(0, 0, 1)).norm(), 1e-3F);
    EXPECT_LT((at(0.5, -0.5) - Eigen::Vector3f::Constant(0.5029F)).norm(), 2e-3F);
    EXPECT_NEAR(at(-0.5, 0.0)[0], 0.5F, 1e-3F);  // between two rows
}

TEST(PathTracer, ThingsThatMoveAreWhereTheyAre) {
    const Scene scene = behindSheet(1.0F, {0, 0, 0});
    MovedShape moved{scene.positions, scene.normals};
    const Object& sheet = scene.object(2);
    for (std::uint32_t v = 0; v < sheet.vertex_count; ++v) {
        moved.positions[sheet.first_vertex + v].x() += 4.0F;  // behind the shining wall
    }
    Scene there = scene;
    there.positions = moved.positions;
    const RayCaster rays(there);
    const PathTracer tracer(scene, rays, darkness(), {}, &moved);
    EXPECT_NEAR(trace(tracer, {0, 0, 0}, {1, 0, 0}, 64).mean.mean(), 1.0, 1e-4);
}

TEST(PathTracer, BackdropsKeepTheirColour) {
    const Scene scene = behindSheet(1.0F, {0, 0, 0});
    const RayCaster rays(scene);
    PathTracerParams params;
    params.exposure = 0.37F;
    const PathTracer tracer(scene, rays, darkness(), params);
    CameraParams camera;
    camera.width_px = camera.height_px = 16;
    View view = makeView(camera, lookAt({0, 0, 0}, {-1, 0, 0}));
    view.backdrop = Eigen::Vector3f(0.2F, 0.5F, 0.8F);
    LayeredImage image;
    ASSERT_TRUE(tracer.add(view, 1, image));
    const auto rgb = developed(averaged(image, params.exposure * std::numbers::pi_v<float>));
    EXPECT_NEAR(rgb[0], 51, 1);
    EXPECT_NEAR(rgb[1], 128, 1);
    EXPECT_NEAR(rgb[2], 204, 1);
}

}  // namespace
}  // namespace dollytrack::render::path_tracer_test
