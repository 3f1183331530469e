#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

#include <opencv2/imgproc.hpp>

namespace dollytrack::render::anisotropy_gl_test {
namespace {

using dollytrack::test::SceneBuilder;

/// A floor with stripes that run away from the camera, each 2 cm wide.
Scene stripedFloor() {
    SceneBuilder builder;
    builder.object("floor", {kNyuFloor, Role::Structure, {1, 1, 1}})
        .quad({0, -2, 0}, {8, 0, 0}, {0, 4, 0});
    Scene scene = builder.build();
    Texture stripes{"stripes", 256, 256, {}};
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const std::uint8_t shade = (y / 4) % 2 == 0 ? 230 : 20;
            stripes.rgba.insert(stripes.rgba.end(), {shade, shade, shade, 255});
        }
    }
    for (std::size_t i = 0; i < scene.positions.size(); ++i) {
        scene.uvs[i] = {scene.positions[i].x() * 0.78F, scene.positions[i].y() * 0.78F};
    }
    scene.textures.push_back(stripes);
    scene.materials[0].texture = 0;
    return scene;
}

class AnisotropyGl : public fixture::GlTest {};

// With anisotropic filtering the stripes stay distinct farther away; without it, the mean over a
// pixel's whole width and height blurs them. The reference is an image of many more pixels, scaled
// down.
TEST_F(AnisotropyGl, FloorsStaySharpFarther) {
    const Scene scene = stripedFloor();
    CameraParams camera;
    camera.width_px = 160;
    camera.height_px = 120;
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer) << describe(renderer.error());
    const Pose pose = lookAt({0.1, 0, 0.25}, {3, 0, 0});
    const auto draw = [&](int places, int times) {
        renderer->scene().setAnisotropy(places);
        CameraParams size = camera;
        size.width_px *= times;
        size.height_px *= times;
        auto target = RenderTarget::create(size.width_px, size.height_px);
        cv::Mat picture(size.height_px, size.width_px, CV_8UC3);
        EXPECT_TRUE(target);
        if (!target) return picture;
        View view = makeView(size, pose);
        view.antialias = Antialias::Samples4;
        EXPECT_TRUE(renderer->scene().draw(view, *target));
        std::vector<std::uint8_t> rgb;
        target->readRgb(rgb);
        std::ranges::copy(rgb, picture.data);
        cv::Mat small;
        cv::resize(picture, small, {camera.width_px, camera.height_px}, 0, 0, cv::INTER_AREA);
        return small;
    };
    const cv::Mat wanted = draw(16, 8);
    const auto away = [&](const cv::Mat& picture) {
        return cv::norm(picture, wanted, cv::NORM_L1);
    };
    const double none = away(draw(1, 1));
    const double eight = away(draw(8, 1));
    EXPECT_LT(eight, 0.7 * none);
    // The default on a software renderer is to leave it out.
    EXPECT_EQ(away(draw(0, 1)), none);
}

}  // namespace
}  // namespace dollytrack::render::anisotropy_gl_test
