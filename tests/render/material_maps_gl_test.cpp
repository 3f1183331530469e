// Normal, roughness, metallic and emission maps, and glass behind glass, against numbers computed
// by hand.

#include "render/materials/traced_surface.h"
#include "render/pathtrace/path_tracer.h"
#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::render::material_maps_gl_test {
namespace {

using dollytrack::test::SceneBuilder;

Texture plainTexture(std::array<std::uint8_t, 4> texel) {
    Texture texture;
    texture.name = "plain";
    texture.width = texture.height = 2;
    for (int i = 0; i < 4; ++i) texture.rgba.insert(texture.rgba.end(), texel.begin(), texel.end());
    return texture;
}

/// A wall 2 x 2 m at x = 1 that faces the origin; u grows along -y, v along z.
Scene wall(int nyu40 = kNyuWall) {
    SceneBuilder builder;
    builder.object("wall", {nyu40, Role::Structure, {0.5F, 0.5F, 0.5F}})
        .quad({1, 1, -1}, {0, -2, 0}, {0, 0, 2});
    Scene scene = builder.build();
    scene.materials[0].roughness = 1.0F;
    const Eigen::Vector3f& a = scene.positions[0];
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        const Eigen::Vector3f from = scene.positions[i] - a;
        scene.uvs[i] = {-0.5F * from.y(), 0.5F * from.z()};
    }
    return scene;
}

class MaterialMapsGl : public fixture::GlTest {
  protected:
    /// Light at the image centre, in a room that is lit from one direction only.
    Eigen::Vector3f lightOf(const Scene& scene, const LightVolume& light) {
        if (!context_) context_ = std::move(*gl::createOsMesaContext());
        CameraParams camera;
        camera.width_px = 32;
        camera.height_px = 32;
        const View view = makeView(camera, lookAt({0, 0, 0}, {1, 0, 0}));
        auto renderer = OffscreenRenderer::create(std::move(context_), scene, light, 32, 32);
        EXPECT_TRUE(renderer) << describe(renderer.error());
        if (!renderer) return Eigen::Vector3f::Zero();
        LightSum sum;
        sum.lens = view.intrinsics;
        sum.last_row = 32;
        EXPECT_TRUE(renderer->scene().beginLight(renderer->target()));
        EXPECT_TRUE(renderer->scene().addLight(view, sum, renderer->target()));
        std::vector<float> values;
        renderer->target().readLight(values);
        const std::size_t middle = 3UL * (16 * 32 + 16);
        return {values[middle], values[middle + 1], values[middle + 2]};
    }

    static LightVolume lampFrom(const Eigen::Vector3f& way) {
        LightVolume light;
        light.low = {-5, -5, -5};
        light.cell_m = 10.0;
        light.cells = {1, 1, 1};
        light.ambient.assign(1, Eigen::Vector3f::Zero());
        light.lamps.assign(1, way);
        return light;
    }
};

// The map's normal leans by 30 degrees along v, which is up here: a lamp from above falls at 60
// degrees onto it, and one from below not at all. Flat, both only graze the wall.
TEST_F(MaterialMapsGl, ANormalMapTurnsTheSurface) {
    Scene scene = wall();
    const auto byte = [](double value) {
        return static_cast<std::uint8_t>(std::lround(255.0 * (0.5 + 0.5 * value)));
    };
    scene.textures.push_back(plainTexture({byte(0.0), byte(0.5), byte(std::sqrt(0.75)), 255}));
    const Eigen::Vector3f flat = lightOf(scene, lampFrom({0, 0, 1}));
    scene.materials[0].normal_map = 0;
    const Eigen::Vector3f up = lightOf(scene, lampFrom({0, 0, 1}));
    const Eigen::Vector3f down = lightOf(scene, lampFrom({0, 0, -1}));
    const Eigen::Vector3f front = lightOf(scene, lampFrom({-1, 0, 0}));
    EXPECT_LT(flat[0], 0.01F);
    EXPECT_NEAR(up[0], 0.5F * 0.5F, 0.01F);
    EXPECT_LT(down[0], 0.01F);
    EXPECT_NEAR(front[0], 0.5F * std::sqrt(0.75F), 0.015F);
    // The scale flattens the map: the slope of 1 / sqrt(3) is halved.
    scene.materials[0].normal_scale = 0.5F;
    const double slope = 0.5 / std::sqrt(3.0);
    EXPECT_NEAR(lightOf(scene, lampFrom({0, 0, 1}))[0], 0.5 * slope / std::hypot(1.0, slope), 0.01);
    // Along u, which is -y here.
    scene.materials[0].normal_scale = 1.0F;
    scene.textures[0] = plainTexture({byte(0.5), byte(0.0), byte(std::sqrt(0.75)), 255});
    EXPECT_NEAR(lightOf(scene, lampFrom({0, -1, 0}))[0], 0.25F, 0.01F);
    EXPECT_LT(lightOf(scene, lampFrom({0, 1, 0}))[0], 0.01F);
}

TEST_F(MaterialMapsGl, TracedSurfacesHaveTheSameMaps) {
    Scene scene = wall();
    scene.textures.push_back(plainTexture({128, 191, 237, 255}));  // leans by 30 degrees along v
    scene.textures.push_back(plainTexture({10, 102, 204, 255}));
    scene.textures.push_back(plainTexture({188, 0, 255, 255}));
    Material& material = scene.materials[0];
    material.normal_map = 0;
    material.roughness_map = material.metallic_map = 1;
    material.emission_map = 2;
    material.metallic = 0.5F;
    material.emission = {1.0F, 1.0F, 0.25F};
    const TracedSurface surface(scene, nullptr);
    const RayCaster rays(scene);
    const Eigen::Vector3d way = Eigen::Vector3d::UnitX();
    const SurfacePoint point = surface.at({0, 0.1, 0.2}, way, rays.cast({0, 0.1, 0.2}, way));
    EXPECT_LT((point.normal - Eigen::Vector3d(-std::sqrt(0.75), 0, 0.5)).norm(), 0.01);
    EXPECT_NEAR(point.roughness, 0.4F, 1e-3F);
    EXPECT_NEAR(point.metallic, 0.4F, 1e-3F);
    EXPECT_NEAR(point.emission[0], std::pow((188 / 255.0 + 0.055) / 1.055, 2.4), 1e-3);
    EXPECT_EQ(point.emission[1], 0.0F);
    EXPECT_NEAR(point.emission[2], 0.25F, 1e-3F);
    // A map that was not found has no effect on normals and roughness; without their maps, metallic
    // and emission are zero.
    for (Texture& texture : scene.textures) texture = {};
    const TracedSurface bare(scene, nullptr);
    const SurfacePoint plain = bare.at({0, 0.1, 0.2}, way, rays.cast({0, 0.1, 0.2}, way));
    EXPECT_NEAR(plain.normal.x(), -1.0, 1e-6);
    EXPECT_EQ(plain.roughness, 1.0F);
    EXPECT_EQ(plain.metallic, 0.0F);
    EXPECT_TRUE(plain.emission.isZero(0.0F));
}

TEST_F(MaterialMapsGl, MetalAndGlowComeFromTheirMaps) {
    Scene scene = wall();
    scene.textures.push_back(plainTexture({0, 255, 255, 255}));
    scene.textures.push_back(plainTexture({0, 255, 0, 255}));
    const LightVolume lamp = lampFrom({-1, 0, 0});
    const float plain = lightOf(scene, lamp)[0];
    EXPECT_NEAR(plain, 0.5F, 0.01F);
    Material& material = scene.materials[0];
    // Metallic 1 everywhere: no diffuse reflection. Metallic factor 1 but 0 in the map: full
    // diffuse reflection.
    material.metallic = 1.0F;
    material.metallic_map = 0;
    EXPECT_LT(lightOf(scene, lamp)[0], 0.25F);  // the lamp's highlight
    material.metallic_map = 1;
    EXPECT_NEAR(lightOf(scene, lamp)[0], plain, 0.01F);
    material.metallic = 0.0F;
    material.metallic_map = -1;
    // The emission has the map's colour, without any other light.
    material.emission = {2.0F, 2.0F, 2.0F};
    material.emission_map = 1;
    const LightVolume dark = lampFrom({0, 0, 0});
    const Eigen::Vector3f glow = lightOf(scene, dark);
    EXPECT_LT(glow[0], 0.01F);
    EXPECT_NEAR(glow[1], 2.0F * std::numbers::pi_v<float>, 0.2F);
    material.emission_map = -1;
    // Non-metals emit all the same.
    material.metallic = 1.0F;
    material.metallic_map = 1;
    EXPECT_NEAR(lightOf(scene, dark)[0], 2.0F * std::numbers::pi_v<float>, 0.2F);
    material.metallic_map = -1;
    scene.textures.clear();
    EXPECT_NEAR(lightOf(scene, dark)[0], 2.0F * std::numbers::pi_v<float>, 0.2F);
}

// The emission of objects that show the outside is scaled with the sky; that of others with the
// lamps.
TEST_F(MaterialMapsGl, GlowGoesWithTheLightItStandsFor) {
    LightVolume evening = lampFrom({0, 0, 0});
    evening.outside_shines = 0.25F;
    evening.lamps_shine = 2.0F;
    // Rounding: half a step of the surface buffer at its brightest emission, and half a step of the
    // vertex attribute.
    constexpr float kRounded = (0.5F * 16.0F + 0.5F * 8.0F) / 255.0F * 2.0F;
    for (const auto& [nyu40, share] : {std::pair(kNyuWindow, 0.25F), std::pair(kNyuWall, 2.0F)}) {
        Scene scene = wall(nyu40);
        scene.materials[0].emission = {1.0F, 1.0F, 1.0F};
        EXPECT_NEAR(lightOf(scene, evening)[0] / std::numbers::pi_v<float>, share, kRounded);
    }
    evening.lamps_shine = 0.0F;
    Scene off = wall();
    off.materials[0].emission = {1.0F, 1.0F, 1.0F};
    EXPECT_LT(lightOf(off, evening)[0], 0.01F) << "a lamp that is off";
}

/// A red pane in front of a blue one in front of a white wall; `far_one_first` gives the order in
/// the file.
Scene panes(bool far_one_first) {
    SceneBuilder builder;
    builder.object("wall", {kNyuWall, Role::Structure, {1.0F, 1.0F, 1.0F}})
        .quad({4, -20, -20}, {0, 40, 0}, {0, 0, 40});
    const auto add = [&](const char* name, double x, const Eigen::Vector3f& color) {
        builder.object(name, {kNyuOtherProp, Role::Target, color})
            .quad({x, -5, -5}, {0, 10, 0}, {0, 0, 10});
    };
    if (far_one_first) add("blue", 3, {0, 0, 1});
    add("red", 2, {1, 0, 0});
    if (!far_one_first) add("blue", 3, {0, 0, 1});
    Scene scene = builder.build();
    scene.materials[1].opacity = scene.materials[2].opacity = 0.5F;
    return scene;
}

// Whatever the order in the file, the near pane is drawn over the far one; labels and depth are
// those of the near pane.
TEST_F(MaterialMapsGl, GlassIsDrawnFromBackToFront) {
    CameraParams camera;
    camera.width_px = 32;
    camera.height_px = 32;
    std::vector<std::vector<std::uint8_t>> seen;
    for (const bool far_one_first : {true, false}) {
        if (!context_) context_ = std::move(*gl::createOsMesaContext());
        const Scene scene = panes(far_one_first);
        auto renderer = makeRenderer(scene, camera);
        ASSERT_TRUE(renderer);
        const auto frame = renderer->render(makeView(camera, lookAt({0, 0, 0}, {1, 0, 0})));
        ASSERT_TRUE(frame);
        const std::size_t middle = 16UL * 32 + 16;
        EXPECT_EQ(scene.object(frame->instance[middle]).name, "red");
        EXPECT_NEAR(frame->depth_m[middle], 2.0F, 1e-4F);
        seen.emplace_back(frame->rgb.begin() + 3 * middle, frame->rgb.begin() + 3 * middle + 3);
        // Blue lets half of the white wall through; red lets half of the rest through and adds its
        // own colour.
        EXPECT_GT(seen.back()[0], seen.back()[2] + 30);
        EXPECT_GT(seen.back()[2], seen.back()[1] + 20);
        // Seen from behind, the order is reversed.
        const auto behind = renderer->render(makeView(camera, lookAt({3.9, 0, 0}, {1, 0, 0})));
        ASSERT_TRUE(behind);
        EXPECT_EQ(scene.object(behind->instance[middle]).name, "blue");
    }
    EXPECT_EQ(seen[0], seen[1]);
}

}  // namespace
}  // namespace dollytrack::render::material_maps_gl_test
