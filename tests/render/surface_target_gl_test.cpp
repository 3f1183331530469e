// Normals and base colours of the labelled surfaces, rendered together with the labels.

#include "render/draw/passes/surface_target.h"
#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

namespace dollytrack::render::surface_target_gl_test {
namespace {

using dollytrack::test::SceneBuilder;

constexpr int kSize = 32;

/// Leaves in which every second texel is a hole, in front of a plain wall; nothing else has a
/// texture.
Scene leaves() {
    SceneBuilder builder;
    builder.object("leaves", {kNyuWall, Role::Target, {1.0F, 1.0F, 1.0F}})
        .quad({1, 2, -2}, {0, -4, 0}, {0, 0, 4});
    builder.object("wall", {kNyuWall, Role::Structure, {0.2F, 0.2F, 0.2F}})
        .quad({3, 9, -9}, {0, -18, 0}, {0, 0, 18});
    Scene scene = builder.build();
    Texture texture;
    texture.name = "leaves";
    texture.width = texture.height = 2;
    texture.rgba = {30, 188, 90, 255, 30, 188, 90, 0, 30, 188, 90, 0, 30, 188, 90, 255};
    scene.textures.push_back(texture);
    scene.materials[0].texture = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        scene.uvs[i] = 2.0F * Eigen::Vector2f(-scene.positions[i].y(), scene.positions[i].z());
    }
    return scene;
}

class SurfaceTargetGl : public fixture::GlTest {
  protected:
    struct Images {
        std::vector<std::uint16_t> ids;
        std::vector<float> depth;
        std::vector<Eigen::Vector3f> normals;
        std::vector<std::uint8_t> albedo;
    };

    static Images read(const RenderTarget& target, const SurfaceTarget& surfaces) {
        Images images;
        target.readIds(images.ids);
        target.readDepth(images.depth);
        surfaces.readNormals(images.normals);
        surfaces.readAlbedo(images.albedo);
        return images;
    }
};

TEST_F(SurfaceTargetGl, CutOutsAloneWithATextureAreWholeInLabelsAndSurfaces) {
    CameraParams camera;
    camera.width_px = camera.height_px = kSize;
    const Scene scene = leaves();
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer) << describe(renderer.error());
    RenderTarget& target = renderer->target();
    auto surfaces = SurfaceTarget::create(target);
    ASSERT_TRUE(surfaces) << describe(surfaces.error());
    View view = makeView(camera, lookAt({0, 0, 0}, {1, 0, 0}));
    ASSERT_TRUE(renderer->scene().drawLabels(view, target, &*surfaces));
    const Images alone = read(target, *surfaces);
    for (std::size_t i = 0; i < alone.ids.size(); ++i) {
        ASSERT_EQ(alone.ids[i], 1) << i;
        EXPECT_NEAR(alone.depth[i], 1.0F, 1e-5F);
        EXPECT_LT((alone.normals[i] - Eigen::Vector3f(-1, 0, 0)).norm(), 1e-4F);
        // The texel itself, through two encodings of 8 bits.
        EXPECT_NEAR(alone.albedo[3 * i], 30, 2);
        EXPECT_NEAR(alone.albedo[3 * i + 1], 188, 2);
        EXPECT_NEAR(alone.albedo[3 * i + 2], 90, 2);
    }
    // They are the same when an image is rendered, too, with any antialiasing, and the image has
    // the holes.
    for (const Antialias antialias : {Antialias::Edges, Antialias::Samples4}) {
        view.antialias = antialias;
        ASSERT_TRUE(renderer->scene().draw(view, target, &*surfaces));
        const Images beside = read(target, *surfaces);
        EXPECT_EQ(beside.ids, alone.ids);
        EXPECT_EQ(beside.depth, alone.depth);
        EXPECT_EQ(beside.normals, alone.normals);
        EXPECT_EQ(beside.albedo, alone.albedo);
        std::vector<std::uint8_t> rgb;
        target.readRgb(rgb);
        int green = 0;
        int grey = 0;
        for (std::size_t i = 0; i < rgb.size(); i += 3) {
            (rgb[i + 1] > rgb[i] + 20 ? green : grey) += 1;
        }
        EXPECT_GT(green, kSize * kSize / 4);
        EXPECT_GT(grey, kSize * kSize / 4);
        view.antialias = Antialias::Edges;
        ASSERT_TRUE(renderer->scene().draw(view, target));  // labels together with the image
        std::vector<std::uint16_t> ids;
        target.readIds(ids);
        EXPECT_EQ(ids, alone.ids);
    }
}

}  // namespace
}  // namespace dollytrack::render::surface_target_gl_test
