// Tests of the sun and the light settings in rendered images.

#include "engine/scene/varied_materials.h"
#include "render/light/tone_curve.h"
#include "render/materials/surface_brdf.h"
#include "render/pathtrace/path_tracer.h"
#include "tests/render/dataset/dataset_fixture.h"
#include "tests/render/lamp_room.h"
#include "tests/render/sunny_room.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::render::light_gl_test {
namespace {

using fixture::Hole;
using fixture::sunAlone;
using fixture::sunnyRoom;

CameraParams squareCamera() {
    CameraParams camera;
    camera.width_px = 200;
    camera.height_px = 200;
    return camera;
}

View smallView(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
    CameraParams camera;
    camera.width_px = 40;
    camera.height_px = 30;
    return makeView(camera, lookAt(eye, target));
}

/// Looks straight down at the floor from below the ceiling: 100 px per metre, the image centre at x
/// = 1.5, y = 1.5.
View downwards() {
    View view = makeView(squareCamera(), Pose{});
    Eigen::Matrix3d axes;  // right is x, down is -y
    axes << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    view.pose.rotation = Eigen::Quaterniond(axes);
    view.pose.position = {1.5, 1.5, 2.5};
    view.orthographic = Orthographic{100.0, 5.0};
    return view;
}

class LightGl : public fixture::GlTest {
  protected:
    /// Light before the tone curve.
    std::vector<float> lightOf(const Scene& scene, const LightVolume& light, const View& view) {
        if (!context_) context_ = std::move(*gl::createOsMesaContext());
        std::vector<float> values;
        auto renderer = OffscreenRenderer::create(std::move(context_), scene, light,
                                                  view.intrinsics.width, view.intrinsics.height);
        EXPECT_TRUE(renderer) << describe(renderer.error());
        if (!renderer) return values;
        LightSum sum;
        sum.lens = view.intrinsics;
        sum.last_row = view.intrinsics.height;
        EXPECT_TRUE(renderer->scene().beginLight(renderer->target()));
        EXPECT_TRUE(renderer->scene().addLight(view, sum, renderer->target()));
        renderer->target().readLight(values);
        return values;
    }

    /// Only the sun's direct light, with the rig's brightness.
    static LightVolume onlySun(const LightRig& rig) {
        LightVolume light;
        light.cells = {1, 1, 1};
        light.ambient.assign(1, Eigen::Vector3f::Zero());
        light.lamps.assign(1, Eigen::Vector3f::Zero());
        light.sun = rig.sun;
        return light;
    }

    /// Mean difference between the rasterized image and the path traced one, whose light is scaled
    /// by `scale`. Compressed as by the tone curve, so that very bright pixels do not dominate.
    double difference(const Scene& scene, const RayCaster& rays, const LightRig& rig,
                      const LightVolume& volume, const View& view, float scale) {
        const std::vector<float> drawn = lightOf(scene, volume, view);
        PathTracerParams params;
        params.exposure = volume.exposure;
        const PathTracer tracer(scene, rays, balanced(rig, volume), params);
        LayeredImage image;
        EXPECT_TRUE(tracer.add(view, 768, image));
        const PictureLayers layers =
            averaged(image, scale * volume.exposure * std::numbers::pi_v<float>);
        double sum = 0.0;
        for (std::size_t i = 0; i < layers.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const float traced = layers.light(i)[static_cast<Eigen::Index>(c)];
                sum += std::abs(std::min(traced, 1.0F) - std::min(drawn[3 * i + c], 1.0F));
            }
        }
        return sum / static_cast<double>(drawn.size());
    }

    static float at(const std::vector<float>& light, double x, double y, std::size_t c = 0) {
        const auto column = static_cast<std::size_t>(100.0 + 100.0 * (x - 1.5));
        const auto row = static_cast<std::size_t>(100.0 - 100.0 * (y - 1.5));
        return light[3 * (row * 200 + column) + c];
    }
};

// At 45 degrees the sun projects the window onto the floor one metre further inside.
TEST_F(LightGl, TheSunDrawsTheWindowOnTheFloor) {
    const Scene scene = sunnyRoom(Hole::Window);
    const std::vector<float> light = lightOf(scene, onlySun(sunAlone(scene)), downwards());
    ASSERT_FALSE(light.empty());
    const float expected = 0.5F * 4.0F * std::sqrt(0.5F);
    EXPECT_NEAR(at(light, 1.5, 1.5), expected, 0.03F * expected);
    EXPECT_NEAR(at(light, 1.5, 1.5, 1), 0.75F * expected, 0.03F * expected);
    for (const double along : {1.1, 1.5, 1.9}) {
        for (const double edge : {1.0, 2.0}) {
            const double inwards = edge < 1.5 ? 0.04 : -0.04;
            EXPECT_GT(at(light, edge + inwards, along), 0.9F * expected) << edge << along;
            EXPECT_EQ(at(light, edge - inwards, along), 0.0F) << edge << along;
            EXPECT_GT(at(light, along, edge + inwards), 0.9F * expected) << edge << along;
            EXPECT_EQ(at(light, along, edge - inwards), 0.0F) << edge << along;
        }
    }
}

// The highlight of the sun on a black, half glossy floor, seen from around the mirror direction,
// must match the BRDF of path tracing. Seen from the sun's side the floor is nearly black.
TEST_F(LightGl, TheSunGlintsAsTheBrdfHasIt) {
    Scene scene = sunnyRoom(Hole::Window);
    for (const float roughness : {0.35F, 0.6F, 0.9F}) {
        scene.materials[0].base_color.setZero();
        scene.materials[0].roughness = roughness;
        const LightRig rig = sunAlone(scene);
        const LightVolume light = onlySun(rig);
        const Eigen::Vector3d target(1.5, 1.5, 0.0);
        double mirrored = 0.0;
        for (const double height_deg : {30.0, 45.0, 60.0, 135.0}) {
            const double height = height_deg * std::numbers::pi / 180.0;
            const Eigen::Vector3d out(std::cos(height), 0.0, std::sin(height));
            View view = makeView(squareCamera(), lookAt(target + 1.2 * out, target));
            const std::vector<float> drawn = lightOf(scene, light, view);
            ASSERT_FALSE(drawn.empty());
            const float found = drawn[3 * (100UL * 200 + 100)];
            const SurfaceBrdf brdf(Eigen::Vector3f::Zero(), 0.0, roughness, out);
            const double slant = rig.sun.way.z();
            const double expected =
                std::numbers::pi * brdf.value(rig.sun.way).x() * rig.sun.irradiance.x() * slant;
            EXPECT_NEAR(found, expected, 0.2 * expected + 0.002) << roughness << " " << height_deg;
            if (height_deg == 45.0) mirrored = found;
            if (height_deg == 135.0 && roughness < 0.5F) {
                EXPECT_LT(found, 0.05 * mirrored);
            }
        }
        EXPECT_GT(mirrored, 0.01);
    }
}

TEST_F(LightGl, NoSunThroughShuttersAndLessThroughGlass) {
    const Scene closed = sunnyRoom(Hole::Shutter);
    const std::vector<float> dark = lightOf(closed, onlySun(sunAlone(closed)), downwards());
    EXPECT_EQ(*std::ranges::max_element(dark), 0.0F);
    // Also no light along the joints of floor and walls on the far side, where the sun is outside
    // the room.
    View far_corner = downwards();
    far_corner.pose.position = {3.0, 2.0, 2.5};
    const std::vector<float> corner = lightOf(closed, onlySun(sunAlone(closed)), far_corner);
    EXPECT_EQ(*std::ranges::max_element(corner), 0.0F);
    const Scene pane = sunnyRoom(Hole::Pane);
    const std::vector<float> less = lightOf(pane, onlySun(sunAlone(pane)), downwards());
    const double through = 0.75 * (1.0 - sheetReflectance(std::sqrt(0.5)));
    const double expected = through * 0.5 * 4.0 * std::sqrt(0.5);
    EXPECT_NEAR(at(less, 1.5, 1.5), expected, 0.03 * expected);
    EXPECT_EQ(at(less, 2.1, 1.5), 0.0F);
}

// The top of a wall whose normals are smoothed over its edges, in a low sun from the side: no
// stripes of its own shadow, neither where it leans towards the sun nor away. A stick over it
// throws one.
TEST_F(LightGl, SmoothedNormalsThrowNoStripes) {
    dollytrack::test::SceneBuilder builder;
    const dollytrack::test::SceneBuilder::Look grey{kNyuWall, Role::Structure, {0.5F, 0.5F, 0.5F}};
    builder.object("wall", grey).box({1.5, 1.5, 0.5}, {0.4, 3.0, 1.0});
    builder.object("stick", grey).box({1.0, 2.35, 1.2}, {0.1, 0.1, 0.6});
    Scene scene = builder.build();
    for (Material& material : scene.materials) material.roughness = 1.0F;
    const Eigen::Vector3f corner(1.5F, 1.5F, 1.0F);
    const float lean = 0.8F;
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const Eigen::Vector3f from = scene.positions[i] - corner;
        if (std::abs(from.z()) > 1e-4F || std::abs(from.x()) > 0.21F) continue;
        if (scene.normals[i].z() < 0.5F) continue;
        scene.normals[i] = Eigen::Vector3f(std::copysign(lean, from.x()), 0.0F, 0.6F);
    }
    LightRig rig = sunAlone(scene);
    for (const double height_deg : {8.0, 15.0, 30.0, 60.0}) {
        const double height = height_deg * std::numbers::pi / 180.0;
        rig.sun.way = {-std::cos(height), 0.0, std::sin(height)};
        const std::vector<float> light = lightOf(scene, onlySun(rig), downwards());
        ASSERT_FALSE(light.empty());
        for (double x = 1.325; x < 1.69; x += 0.01) {
            const Eigen::Vector3d n =
                Eigen::Vector3d(lean * (x - 1.5) / 0.2, 0.0, 0.6).normalized();
            const double expected = 2.0 * std::max(n.dot(rig.sun.way), 0.0);
            for (double y = 0.605; y < 2.2; y += 0.03) {
                ASSERT_NEAR(at(light, x, y), expected, 0.05) << height_deg << " " << x << " " << y;
            }
        }
        if (height_deg < 40.0) {
            EXPECT_EQ(at(light, 1.36, 2.35), 0.0F) << height_deg;
        }
    }
}

// The ground reaches further than the shadow map: beyond it the sun shines.
TEST_F(LightGl, TheSunShinesBehindTheShadowOfTheBuilding) {
    dollytrack::test::SceneBuilder builder;
    builder.object("ground", {kNyuFloor, Role::Structure, {0.5F, 0.5F, 0.5F}})
        .quad({-20, -20, 0}, {40, 0, 0}, {0, 40, 0});
    builder.object("wall", {kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}})
        .quad({4, 0, 0}, {0, 3, 0}, {0, 0, 2.6});
    Scene scene = builder.build();
    for (Material& material : scene.materials) material.roughness = 1.0F;
    LightRig rig = sunAlone(scene);
    rig.sun.shades = {Eigen::Vector3d(-0.5, -0.5, -0.5), Eigen::Vector3d(4.5, 3.5, 3.1)};
    View view = downwards();
    view.pose.position.x() += 5.0;
    const std::vector<float> light = lightOf(scene, onlySun(rig), view);
    const float expected = 0.5F * 4.0F * std::sqrt(0.5F);
    for (const double x : {5.8, 6.3}) EXPECT_EQ(at(light, x - 5.0, 1.5), 0.0F) << x;
    for (const double x : {6.8, 7.4}) EXPECT_NEAR(at(light, x - 5.0, 1.5), expected, 0.04F) << x;
}

// Baked, rasterized and traced light agree, both direct sunlight and its bounces.
TEST_F(LightGl, DrawnAndTracedPicturesAgreeInTheSun) {
    const Scene scene = sunnyRoom(Hole::Window);
    const RayCaster rays(scene);
    LightRig rig = sunAlone(scene);
    rig.sky_strength = 0.5;
    const LightVolume volume = bakeLightVolume(scene, rays, rig);
    const View view = smallView({3.7, 2.7, 1.8}, {1.0, 1.3, 0.8});
    EXPECT_LT(difference(scene, rays, rig, volume, view, 1.0F), 0.08);
    EXPECT_GT(difference(scene, rays, rig, volume, view, 1.5F), 0.12);
}

// Rasterized and traced images agree for a table lamp and the room's lamp, and leaving out the
// table lamp would change more than they differ.
TEST_F(LightGl, DrawnAndTracedPicturesAgreeBesideATableLamp) {
    const Scene scene = fixture::lampRoom(0.8F);
    const RayCaster rays(scene);
    const LightRig rig = makeLightRig(scene, rays);
    ASSERT_EQ(rig.scene_lamps.size(), 1U);
    const View view = smallView({1.6, 2.2, 1.6}, {0.1, 1.5, 1.1});
    const LightVolume volume = bakeLightVolume(scene, rays, rig);
    EXPECT_LT(difference(scene, rays, rig, volume, view, 1.0F), 0.06);
    LightRig without = rig;
    without.scene_lamps.clear();
    const LightVolume dim = bakeLightVolume(scene, rays, without);
    EXPECT_GT(difference(scene, rays, rig, dim, view, 1.0F), 0.1);
    // The exposure of the whole room stays about the same.
    EXPECT_NEAR(volume.exposure, dim.exposure, 0.25F * dim.exposure);
}

// In a high hall the floor is about as bright as in a room, and as path tracing has it.
TEST_F(LightGl, AHighHallIsNotDark) {
    dollytrack::test::SceneBuilder builder;
    const double x = 15.0, y = 20.0, z = 10.0;
    const Eigen::Vector3f paint(0.7F, 0.7F, 0.7F);
    builder.object("floor", {kNyuFloor, Role::Structure, paint})
        .quad({0, 0, 0}, {x, 0, 0}, {0, y, 0});
    builder.object("ceiling", {kNyuCeiling, Role::Structure, paint})
        .quad({0, 0, z}, {0, y, 0}, {x, 0, 0});
    builder.object("walls", {kNyuWall, Role::Structure, paint})
        .quad({0, 0, 0}, {0, y, 0}, {0, 0, z})
        .quad({x, 0, 0}, {0, 0, z}, {0, y, 0})
        .quad({0, 0, 0}, {0, 0, z}, {x, 0, 0})
        .quad({0, y, 0}, {x, 0, 0}, {0, 0, z});
    builder.object("table", {kNyuOtherFurniture, Role::Target, paint})
        .box({7, 9, 0.4}, {2, 1, 0.8});
    Scene scene = builder.build();
    for (Material& material : scene.materials) material.roughness = 1.0F;
    const RayCaster rays(scene);
    const LightRig rig = makeLightRig(scene, rays);
    const LightVolume volume = bakeLightVolume(scene, rays, rig);
    const View view = smallView({3.0, 3.0, 1.5}, {7.0, 9.0, 0.6});
    const std::vector<float> drawn = lightOf(scene, volume, view);
    double mean = 0.0;
    for (const float value : drawn) mean += value / static_cast<double>(drawn.size());
    EXPECT_GT(mean, 0.2);
    EXPECT_LT(mean, 1.0);
    EXPECT_LT(difference(scene, rays, rig, volume, view, 1.0F), 0.1);
}

// A surface that also emits a little blue light, as some files have it, keeps its own colour.
TEST_F(LightGl, FaintEmissionLeavesTheColourOfASurface) {
    Scene scene = fixture::lampRoom(0.8F);
    const RayCaster rays(scene);
    const LightVolume volume = bakeLightVolume(scene, rays, makeLightRig(scene, rays));
    const View view = smallView({1.6, 2.2, 1.6}, {0.1, 1.5, 1.1});
    const std::vector<float> plain = lightOf(scene, volume, view);
    for (Material& material : scene.materials) {
        if (material.emission.isZero(0.0F)) material.emission = {0.0006F, 0.0013F, 0.017F};
    }
    const std::vector<float> faint = lightOf(scene, volume, view);
    ASSERT_EQ(faint.size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
        ASSERT_NEAR(faint[i], plain[i], 0.02F) << "value " << i;
    }
}

// The lamps of a room without a ceiling hang 3 m high and shine down. The walls above them have the
// light of the sky and of a small bright screen, without blotches.
TEST_F(LightGl, TheWallsOfAnOpenRoomAreLitEvenlyAboveItsLamps) {
    dollytrack::test::SceneBuilder builder;
    const Eigen::Vector3f paint(0.7F, 0.7F, 0.7F);
    builder.object("floor", {kNyuFloor, Role::Structure, paint})
        .quad({0, 0, 0}, {6, 0, 0}, {0, 6, 0});
    builder.object("walls", {kNyuWall, Role::Structure, paint})
        .box({-0.02, 3, 2.8}, {0.04, 6.1, 5.6})
        .box({3, 6.02, 2.8}, {6, 0.04, 5.6});
    builder.object("screen").box({4.0, 3.0, 1.0}, {0.4, 0.4, 0.4});
    Scene scene = builder.build();
    for (Material& material : scene.materials) material.roughness = 1.0F;
    const std::uint32_t screen = scene.objects.back().first_triangle;
    scene.materials[scene.triangle_material[screen]].emission.setConstant(8.0F);
    const RayCaster rays(scene);
    const LightRig rig = makeLightRig(scene, rays);
    const LightVolume volume = bakeLightVolume(scene, rays, rig);
    const View view = smallView({3.0, 3.0, 3.8}, {1.5, 6.0, 4.4});
    EXPECT_LT(difference(scene, rays, rig, volume, view, 1.0F), 0.1);
    const std::vector<float> drawn = lightOf(scene, volume, view);
    for (std::size_t y = 6; y < 30; ++y) {  // the wall at y = 6
        for (std::size_t x = 16; x + 1 < 40; ++x) {
            const std::size_t pixel = 3 * (y * 40 + x);
            EXPECT_NEAR(drawn[pixel], drawn[pixel + 3], 0.04F) << x << ", " << y;
        }
    }
}

class DatasetLightGl : public fixture::DatasetGlTest {
  protected:
    std::string pictureWith(const LightParams& light, const char* name) {
        DatasetSettings settings;
        settings.folder = folder_ / name;
        settings.light = light;
        settings.modalities = {"rgb", "depth", "instance"};
        const auto summary = exportWith(settings, fixture::circle(1));
        EXPECT_TRUE(summary) << describe(summary.error());
        return read(settings.folder / "rgb/000000.png");
    }
};

TEST_F(DatasetLightGl, TheSameSeedIsTheSamePictureAndAnotherIsNot) {
    const std::string neutral = pictureWith({}, "neutral");
    LightParams seeded;
    seeded.light_seed = 9;  // has no effect without a variation
    EXPECT_EQ(pictureWith(seeded, "seeded"), neutral);
    LightParams varied = lightPreset(LightPreset::Evening);
    varied.light_variation = 0.8;
    const std::string first = pictureWith(varied, "first");
    EXPECT_NE(first, neutral);
    EXPECT_EQ(pictureWith(varied, "again"), first);
    varied.light_seed = 2;
    EXPECT_NE(pictureWith(varied, "other"), first);
    // Depth and labels do not depend on the light.
    for (const char* file : {"depth/000000.png", "instance/000000.png"}) {
        EXPECT_EQ(read(folder_ / "first" / file), read(folder_ / "neutral" / file)) << file;
        EXPECT_FALSE(read(folder_ / "first" / file).empty()) << file;
    }
    const auto card = nlohmann::json::parse(read(folder_ / "first/dataset.json"));
    const auto drawn = nlohmann::json(toJson(resolved([&] {
        varied.light_seed = 1;
        return varied;
    }())));
    EXPECT_EQ(card.at("light"), drawn);
}

// Clouds are grey, and the ground below them is no browner than by day.
TEST(Sky, IsGreyWhenOvercastOverTheSameGround) {
    const auto colorOf = [](float rise, LightPreset preset) {
        const ResolvedLight light = resolved(lightPreset(preset));
        const Eigen::Vector3f color =
            decoded(skyBackdrop(rise, light.backdrop_grey)).cwiseProduct(light.backdrop_factor);
        return Eigen::Vector3f(color / color.mean());
    };
    const auto colorful = [](const Eigen::Vector3f& color) {
        return color.maxCoeff() - color.minCoeff();
    };
    for (const float rise : {-1.0F, -0.5F, -0.13F}) {
        const Eigen::Vector3f ground = colorOf(rise, LightPreset::Overcast);
        EXPECT_LT((ground - colorOf(rise, LightPreset::Day)).norm(), 0.08F) << rise;
        EXPECT_LT(colorful(ground), 0.1F) << rise;
    }
    for (const float rise : {0.0F, 0.3F, 1.0F}) {
        EXPECT_LT(colorful(colorOf(rise, LightPreset::Overcast)), 0.2F) << rise;
    }
    EXPECT_GT(colorful(colorOf(1.0F, LightPreset::Day)), 0.5F);
}

// At night no light at all comes through the window; the lamps still light the room.
TEST_F(LightGl, ANightHasNoDaylight) {
    const Scene scene = sunnyRoom(Hole::Window);
    const RayCaster rays(scene);
    LightParams night = lightPreset(LightPreset::Night);
    const auto volumeOf = [&](const LightParams& params) {
        LightVolumeParams coarse;
        coarse.max_cells = 3000;
        return bakeLightVolume(scene, rays, makeLightRig(scene, rays, {}, resolved(params)),
                               coarse);
    };
    const auto meanOf = [&](const LightVolume& volume) {
        const std::vector<float> light = lightOf(scene, volume, downwards());
        double sum = 0.0;
        for (const float one : light) sum += one;
        return sum / static_cast<double>(light.size());
    };
    const double at_night = meanOf(volumeOf(night));
    const double by_day = meanOf(volumeOf(lightPreset(LightPreset::Day)));
    EXPECT_GT(at_night, 0.05);
    EXPECT_LT(at_night, 0.8 * by_day);
    night.lamp_strength = 0.0;
    const LightVolume black = volumeOf(night);
    for (const Eigen::Vector3f& ambient : black.ambient) ASSERT_EQ(ambient.maxCoeff(), 0.0F);
    EXPECT_EQ(meanOf(black), 0.0);
    // Without lamps the room is not black by day or under an overcast sky.
    for (const LightPreset preset : {LightPreset::Day, LightPreset::Overcast}) {
        LightParams lit = lightPreset(preset);
        lit.lamp_strength = 0.0;
        EXPECT_GT(meanOf(volumeOf(lit)), 0.05);
    }
    // Only the preset Day has a sun.
    EXPECT_TRUE(volumeOf(lightPreset(LightPreset::Day)).sun.shines());
    EXPECT_FALSE(volumeOf(lightPreset(LightPreset::Overcast)).sun.shines());
    EXPECT_FALSE(volumeOf({}).sun.shines());
}

}  // namespace
}  // namespace dollytrack::render::light_gl_test
