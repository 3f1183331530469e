#include "render/pathtrace/layered_image.h"

#include "engine/core/random.h"
#include "engine/jobs/parallel.h"
#include "render/light/light_volume.h"
#include "render/materials/surface_brdf.h"
#include "render/pathtrace/denoiser.h"
#include "render/pathtrace/path_tracer.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::render::layered_image_test {
namespace {

using dollytrack::test::SceneBuilder;

constexpr int kWidth = 48;
constexpr int kHeight = 32;
constexpr double kPi = std::numbers::pi;

/// A surface at a pixel: its position relative to the camera, its normal and its reflectance.
struct Place {
    Eigen::Vector3f position, normal, reflectance;
};

/// A wall across the view, 2 m away.
Place onWall(int x, int y) {
    return {{0.05F * static_cast<float>(x - kWidth / 2), 0.05F * static_cast<float>(y), 2.0F},
            {0.0F, 0.0F, -1.0F},
            {0.5F, 0.5F, 0.5F}};
}

/// An image of direct light with the given illumination, and independent noise of the given
/// standard deviation in each set's mean.
template <class PlaceAt, class Illumination>
LayeredImage imageOf(PlaceAt&& placeAt, Illumination&& illumination, double noise) {
    LayeredImage image;
    image.width = kWidth;
    image.height = kHeight;
    image.samples = 8;
    image.sets.resize(2);
    Random random(3, 0);
    for (std::size_t set = 0; set < 2; ++set) {
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const Place place = placeAt(x, y);
                const double value = illumination(x, y) + noise * random.normal();
                LayeredLight light;
                light.direct = 4.0F * static_cast<float>(value) * place.reflectance;
                light.reflectance = 4.0F * place.reflectance;
                light.normal = 4.0F * place.normal;
                light.position = 4.0F * place.position;
                light.distance = 4.0F * place.position.norm();
                light.hits = 4.0F;
                image.sets[set].push_back(light);
            }
        }
    }
    return image;
}

std::size_t at(int x, int y) {
    return static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
}

/// Root mean square difference of the illumination from the true one.
template <class Illumination>
double error(const PictureLayers& layers, Illumination&& illumination) {
    double sum = 0.0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const double off = double{layers.direct[at(x, y)].x()} - illumination(x, y);
            sum += off * off;
        }
    }
    return std::sqrt(sum / (kWidth * kHeight));
}

TEST(Denoised, NoiseOnAWallFallsToASeventh) {
    const auto even = [](int, int) { return 1.0; };
    const LayeredImage image = imageOf(onWall, even, 0.2);
    EXPECT_GT(error(averaged(image, 1.0F), even), 0.12);
    EXPECT_LT(error(denoised(image, 1.0F), even), 0.02);
}

TEST(Denoised, LightThatFallsOffLinearlyStaysAsItIs) {
    const auto slope = [](int x, int y) { return 0.2 + 0.03 * x + 0.01 * y; };
    EXPECT_LT(error(denoised(imageOf(onWall, slope, 0.0), 1.0F), slope), 1e-3);
    EXPECT_LT(error(denoised(imageOf(onWall, slope, 0.1), 1.0F), slope), 0.02);
}

// Two walls meet in a corner, one bright and one dark.
TEST(Denoised, LightDoesNotSpreadFromOneSurfaceToAnother) {
    const auto corner = [](int x, int y) {
        Place place = onWall(x, y);
        if (x >= kWidth / 2) {
            place.normal = {-1.0F, 0.0F, 0.0F};
            place.position = {0.0F, place.position.y(), 2.0F - place.position.x()};
        }
        return place;
    };
    const auto light = [](int x, int) { return x < kWidth / 2 ? 1.0 : 0.3; };
    const PictureLayers layers = denoised(imageOf(corner, light, 0.1), 1.0F);
    EXPECT_LT(error(layers, light), 0.02);
    // The same light on a flat wall is an unexplained step below the noise, which is blurred.
    const auto faint = [](int x, int) { return x < kWidth / 2 ? 1.0 : 0.9; };
    const auto columnError = [&](const PictureLayers& of) {
        double sum = 0.0;
        for (int y = 0; y < kHeight; ++y) sum += of.direct[at(kWidth / 2 - 1, y)].x() - 1.0;
        return std::abs(sum) / kHeight;
    };
    EXPECT_LT(columnError(denoised(imageOf(corner, faint, 0.3), 1.0F)), 0.04);
    EXPECT_GT(columnError(denoised(imageOf(onWall, faint, 0.3), 1.0F)), 0.04);
}

TEST(Denoised, ASharpShadowAboveTheNoiseStaysSharp) {
    const auto shadow = [](int x, int) { return x < kWidth / 2 ? 1.0 : 0.2; };
    EXPECT_LT(error(denoised(imageOf(onWall, shadow, 0.05), 1.0F), shadow), 0.05);
}

TEST(Denoised, TexturesStayAsTheyAre) {
    const auto checkered = [](int x, int y) {
        Place place = onWall(x, y);
        if ((x + y) % 2 == 0) place.reflectance = {0.9F, 0.1F, 0.0F};
        return place;
    };
    const auto even = [](int, int) { return 1.0; };
    const LayeredImage image = imageOf(checkered, even, 0.1);
    const PictureLayers layers = denoised(image, 1.0F);
    for (int x = 4; x < 8; ++x) {
        const Eigen::Vector3f expected = checkered(x, 5).reflectance;
        EXPECT_LT((layers.light(at(x, 5)) - expected).norm(), 0.03F) << x;
    }
}

/// A room with a red wall, a lamp and a block.
Scene room() {
    SceneBuilder builder;
    const auto wall = [](const Eigen::Vector3f& color) {
        return SceneBuilder::Look{kNyuWall, Role::Structure, color};
    };
    builder.object("floor", wall({0.7F, 0.7F, 0.7F})).quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0});
    builder.object("ceiling", wall({0.7F, 0.7F, 0.7F})).quad({0, 0, 2.5}, {0, 3, 0}, {3, 0, 0});
    builder.object("back", wall({0.7F, 0.7F, 0.7F})).quad({0, 3, 0}, {3, 0, 0}, {0, 0, 2.5});
    builder.object("front", wall({0.7F, 0.7F, 0.7F})).quad({0, 0, 0}, {0, 0, 2.5}, {3, 0, 0});
    builder.object("left", wall({0.7F, 0.1F, 0.1F})).quad({0, 0, 0}, {0, 3, 0}, {0, 0, 2.5});
    builder.object("right", wall({0.6F, 0.6F, 0.6F})).quad({3, 0, 0}, {0, 0, 2.5}, {0, 3, 0});
    builder.object("block", {kNyuOtherProp, Role::Target, {0.3F, 0.5F, 0.8F}})
        .box({1.9, 2.0, 0.4}, {0.6, 0.6, 0.8}, 0.4);
    Scene scene = builder.build();
    scene.room_bounds = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, 3, 2.5));
    return scene;
}

LightRig lampInRoom() {
    LightRig rig;
    rig.lamps.push_back({{1.5, 1.5, 2.3}, 0.3, 2.0});
    return rig;
}

View viewOf(int width, int height) {
    CameraParams camera;
    camera.width_px = width;
    camera.height_px = height;
    return makeView(camera, lookAt({0.8, 0.3, 1.4}, {1.6, 2.4, 0.7}));
}

// A single matt plane under a lamp: the direct layer is the integral over the lamp, and nothing is
// indirect.
TEST(LayeredImage, DirectLightOfAPlaneIsTheIntegralOverTheLamp) {
    SceneBuilder builder;
    builder.object("floor", {kNyuFloor, Role::Structure, {0.6F, 0.4F, 0.2F}})
        .quad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
    Scene scene = builder.build();
    scene.materials[0].roughness = 0.5F;
    const RayCaster rays(scene);
    LightRig rig;
    rig.lamp_color.setOnes();
    rig.sky_strength = 0.0;
    rig.lamps.push_back({{0.0, 0.0, 2.0}, 0.5, 3.0});
    const PathTracer tracer(scene, rays, rig);
    const Eigen::Vector3d eye(-0.6, 0.1, 0.8);
    LayeredImage image;
    image.width = image.height = 1;
    const auto ray = [&](double, double) { return ViewRay{eye, -eye}; };
    ASSERT_TRUE(tracer.add(ray, 0.0, 4096, image));
    const PictureLayers layers = averaged(image, 1.0F);

    const Lamp& lamp = rig.lamps.front();
    const SurfaceBrdf brdf(scene.materials[0].base_color, 0.0, 0.5, eye.normalized());
    double diffuse = 0.0;
    double glossy = 0.0;
    constexpr int kRings = 200;
    for (int i = 0; i < kRings; ++i) {
        for (int j = 0; j < 2 * kRings; ++j) {
            const double r = lamp.radius_m * (i + 0.5) / kRings;
            const double angle = kPi * (j + 0.5) / kRings;
            const Eigen::Vector3d on_lamp =
                lamp.position + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0.0);
            const Eigen::Vector3d way = on_lamp.normalized();
            const double area = r * (lamp.radius_m / kRings) * (kPi / kRings);
            const double arrives =
                lamp.radiance() * way.z() * way.z() * area / on_lamp.squaredNorm();
            diffuse += brdf.layers(way).diffuse * arrives;
            glossy += brdf.layers(way).glossy.mean() * arrives;
        }
    }
    EXPECT_TRUE(layers.reflectance[0].isApprox(Eigen::Vector3f(0.6F, 0.4F, 0.2F), 1e-4F));
    EXPECT_NEAR(layers.direct[0].x(), diffuse, 0.01 * diffuse);
    EXPECT_NEAR(layers.direct[0].z(), diffuse, 0.01 * diffuse);
    EXPECT_NEAR(layers.residual[0].mean(), glossy, 0.02 * glossy);
    EXPECT_EQ(layers.indirect[0].norm(), 0.0F);
}

// The red wall reflects more red than blue light into the room, onto what is not red itself.
TEST(LayeredImage, IndirectLightHasTheColourOfTheWallsAndAllLayersAddUp) {
    const Scene scene = room();
    const RayCaster rays(scene);
    LightRig rig;
    rig.lamp_color.setOnes();
    rig.lamps.push_back({{1.5, 1.5, 2.3}, 0.3, 2.0});
    const PathTracer tracer(scene, rays, rig);
    LayeredImage image;
    ASSERT_TRUE(tracer.add(viewOf(24, 18), 64, image));
    const PictureLayers layers = averaged(image, 1.0F);
    Eigen::Vector3d direct = Eigen::Vector3d::Zero();
    Eigen::Vector3d indirect = Eigen::Vector3d::Zero();
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * 24 + static_cast<std::size_t>(x);
            EXPECT_LT((layers.light(i) - image.at(x, y)).norm(), 1e-5F);
            direct += layers.direct[i].cast<double>();
            indirect += layers.indirect[i].cast<double>();
        }
    }
    EXPECT_NEAR(direct.x(), direct.z(), 0.01 * direct.x());
    EXPECT_GT(indirect.x(), 1.1 * indirect.z());
}

TEST(LayeredImage, IsDenoisedToTheSameBytesOnAnyNumberOfThreads) {
    const Scene scene = room();
    const RayCaster rays(scene);
    const LightRig rig = lampInRoom();
    const PathTracer tracer(scene, rays, rig);
    const auto bytes = [&](int threads) {
        setThreadCount(threads);
        LayeredImage image;
        image.sets.resize(2);
        EXPECT_TRUE(tracer.add(viewOf(40, 30), 4, image));
        const auto rgb = developed(denoised(image, 2.0F));
        setThreadCount(0);
        return rgb;
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

TEST(LayeredImage, IsTheSameInPartsOfAnySize) {
    const Scene scene = room();
    const RayCaster rays(scene);
    const LightRig rig = lampInRoom();
    const PathTracer tracer(scene, rays, rig);
    const View view = viewOf(40, 100);
    const auto bytes = [&](bool denoises, int pixels_at_once) {
        PathTracer::Picture picture;
        picture.width = 40;
        picture.height = 100;
        picture.samples = 4;
        picture.scale = 2.0F;
        picture.denoises = denoises;
        picture.pixels_at_once = pixels_at_once;
        const auto ray = [&](double x, double y) { return view.rayThrough(x, y); };
        const auto layers = tracer.take(ray, view.near_m, picture);
        EXPECT_TRUE(layers);
        return layers ? developed(*layers) : std::vector<std::uint8_t>();
    };
    for (const bool denoises : {false, true}) {
        const auto whole = bytes(denoises, 1 << 20);
        EXPECT_EQ(whole.size(), 3U * 40U * 100U);
        for (const int pixels : {1, 40 * 6, 40 * 31}) {
            EXPECT_EQ(bytes(denoises, pixels), whole) << denoises << ' ' << pixels;
        }
    }
    EXPECT_NE(bytes(false, 1), bytes(true, 1));
}

/// Sums of the layers' light over an image, in the order direct, indirect, residual.
std::array<Eigen::Vector3d, 3> sumsOf(const PictureLayers& layers) {
    std::array<Eigen::Vector3d, 3> sums;
    for (Eigen::Vector3d& sum : sums) sum.setZero();
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const Eigen::Vector3f& reflectance = layers.reflectance[i];
        sums[0] += reflectance.cwiseProduct(layers.direct[i]).cast<double>();
        sums[1] += reflectance.cwiseProduct(layers.indirect[i]).cast<double>();
        sums[2] += layers.residual[i].cast<double>();
    }
    return sums;
}

// Paths that end in the light volume give nearly the same light as whole ones, in each layer, with
// the sun shining in, too.
TEST(LayeredImage, PathsThatEndInTheLightVolumeGiveNearlyTheSameLayers) {
    const Scene scene = room();
    const RayCaster rays(scene);
    for (const bool sunny : {false, true}) {
        LightRig rig = lampInRoom();
        if (sunny) {
            rig.sun.way = Eigen::Vector3d(0.3, -1.0, 0.6).normalized();
            rig.sun.irradiance.setConstant(8.0F);
            // Nothing casts a shadow of the sun, so that it shines through walls and ceiling.
            rig.sun.shades =
                Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, -9), Eigen::Vector3d(1, 1, -8));
        }
        const LightVolume volume = bakeLightVolume(scene, rays, rig);
        const View view = viewOf(40, 30);
        const auto sums = [&](const LightVolume* end_light) {
            PathTracerParams params;
            params.end_light = end_light;
            const PathTracer tracer(scene, rays, balanced(rig, volume), params);
            LayeredImage image;
            EXPECT_TRUE(tracer.add(view, 64, image));
            return sumsOf(averaged(image, 1.0F));
        };
        const auto whole = sums(nullptr);
        const auto ended = sums(&volume);
        EXPECT_NEAR(ended[0].norm(), whole[0].norm(), 0.01 * whole[0].norm()) << sunny;
        EXPECT_NEAR(ended[1].norm(), whole[1].norm(), 0.12 * whole[1].norm()) << sunny;
        EXPECT_NEAR(ended[2].norm(), whole[2].norm(), 0.12 * whole[2].norm()) << sunny;
        EXPECT_GT(whole[1].norm(), 0.1 * whole[0].norm());
        LightVolume brighter = volume;
        for (Eigen::Vector3f& light : brighter.ambient) light *= 2.0F;
        EXPECT_GT(sums(&brighter)[1].norm(), 1.12 * whole[1].norm());
    }
}

// Through a pane the layers describe the wall behind it, in all samples alike; through a nearly
// opaque one, the pane.
TEST(LayeredImage, DescribesWhatIsBehindGlass) {
    for (const float opacity : {0.2F, 0.9F}) {
        SceneBuilder builder;
        builder.object("wall", {kNyuWall, Role::Structure, {0.8F, 0.4F, 0.2F}})
            .quad({-9, 4, -9}, {18, 0, 0}, {0, 0, 18});
        builder.object("pane", {kNyuOtherProp, Role::Target, {0.1F, 0.2F, 0.3F}})
            .quad({-9, 2, -9}, {18, 0, 0}, {0, 0, 18});
        Scene scene = builder.build();
        scene.materials[1].opacity = opacity;
        const RayCaster rays(scene);
        LightRig rig;
        rig.sky_strength = 1.0;
        const PathTracer tracer(scene, rays, rig);
        LayeredImage image;
        image.width = 8;
        image.height = 6;
        const auto ray = [](double x, double y) {
            return ViewRay{{0, 0, 0}, {0.1 * (x - 4), 1.0, 0.1 * (3 - y)}};
        };
        ASSERT_TRUE(tracer.add(ray, 0.01, 16, image));
        const PictureLayers layers = averaged(image, 1.0F);
        const std::size_t shown = opacity < 0.5F ? 0 : 1;
        for (const Eigen::Vector3f& reflectance : layers.reflectance) {
            EXPECT_TRUE(reflectance.isApprox(scene.materials[shown].base_color, 1e-4F)) << opacity;
        }
        EXPECT_GT(layers.residual[0].norm(), 0.0F);
    }
}

// The difference of the two sets shows how far their mean is from the truth.
TEST(LayeredImage, TheSetsShowTheNoise) {
    const Scene scene = room();
    const RayCaster rays(scene);
    const LightRig rig = lampInRoom();
    const PathTracer tracer(scene, rays, rig);
    const View view = viewOf(32, 24);
    LayeredImage right;
    ASSERT_TRUE(tracer.add(view, 1024, right));
    LayeredImage image;
    image.sets.resize(2);
    ASSERT_TRUE(tracer.add(view, 8, image));
    double shown = 0.0;
    double real = 0.0;
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 32; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * 32 + static_cast<std::size_t>(x);
            shown += ((image.sets[0][i].sum() - image.sets[1][i].sum()) / 8.0F).squaredNorm();
            real += (image.at(x, y) - right.at(x, y)).squaredNorm();
        }
    }
    EXPECT_GT(shown, 0.7 * real);
    EXPECT_LT(shown, 1.4 * real);
}

}  // namespace
}  // namespace dollytrack::render::layered_image_test
