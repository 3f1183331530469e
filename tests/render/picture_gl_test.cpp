#include "render/draw/overview.h"
#include "render/overlays/overlay_painter.h"
#include "render/pathtrace/path_tracer.h"
#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdlib>
#include <filesystem>
#include <numbers>

namespace dollytrack::render::picture_gl_test {
namespace {

using dollytrack::test::furnishedRoom;
using dollytrack::test::SceneBuilder;

CameraParams goldenCamera() {
    CameraParams camera;
    camera.width_px = 128;
    camera.height_px = 96;
    camera.hfov_deg = 75.0;
    return camera;
}

class PictureGl : public fixture::GlTest {
  protected:
    /// Brightness of a black wall behind a clear pane at x = 2 m, turned about z.
    double blackBehindPane(double turn_deg, bool with_pane = true) {
        SceneBuilder builder;
        builder.object("wall", {kNyuWall, Role::Structure, {0.0F, 0.0F, 0.0F}})
            .quad({4, -20, -20}, {0, 40, 0}, {0, 0, 40});
        const double turn = turn_deg * std::numbers::pi / 180.0;
        const Eigen::Vector3d along(std::sin(turn), std::cos(turn), 0.0);
        builder.object("pane", {kNyuOtherStructure, Role::Structure, {0.8F, 0.8F, 0.8F}})
            .quad(Eigen::Vector3d(2, 0, -5) - 2.0 * along, 4.0 * along,
                  {0, 0, with_pane ? 10.0 : 1.0});
        Scene scene = builder.build();
        scene.materials[1].opacity = 0.01F;
        const CameraParams camera = goldenCamera();
        if (!context_) context_ = std::move(*gl::createOsMesaContext());
        auto renderer = makeRenderer(scene, camera);
        EXPECT_TRUE(renderer);
        const auto frame = renderer->render(makeView(camera, lookAt({0, 0, 0}, {1, 0, 0})));
        EXPECT_TRUE(frame);
        return frame->rgb[3 * (48UL * 128 + 64)];
    }
};

cv::Mat asMat(const FrameRecord& frame) {
    cv::Mat bgr(frame.height, frame.width, CV_8UC3);
    for (std::size_t i = 0; i < frame.rgb.size(); ++i)
        bgr.data[i - i % 3 + 2 - i % 3] = frame.rgb[i];
    return bgr;
}

struct Difference {
    double mean = 0.0;
    double max = 0.0;
};

Difference compare(const cv::Mat& a, const cv::Mat& b) {
    cv::Mat difference;
    cv::absdiff(a, b, difference);
    Difference result;
    cv::minMaxLoc(difference.reshape(1), nullptr, &result.max);
    const cv::Scalar mean = cv::mean(difference);
    result.mean = (mean[0] + mean[1] + mean[2]) / 3.0;
    return result;
}

// Changes of the light, the shaders or the geometry make this test fail. Run with
// DOLLYTRACK_UPDATE_GOLDEN=1 to accept a new image, and explain the change in the commit.
TEST_F(PictureGl, LooksLikeTheGoldenImage) {
    const Scene scene = furnishedRoom();
    const CameraParams camera = goldenCamera();
    auto renderer = makeRenderer(scene, camera, /*lit=*/true);
    ASSERT_TRUE(renderer) << describe(renderer.error());
    const auto frame = renderer->render(makeView(camera, lookAt({0.4, 0.3, 1.8}, {3.1, 2.0, 0.7})));
    ASSERT_TRUE(frame);
    const cv::Mat actual = asMat(*frame);
    const std::string path = std::string(DOLLYTRACK_GOLDEN_FOLDER) + "/furnished_room.png";
    if (std::getenv("DOLLYTRACK_UPDATE_GOLDEN") != nullptr) cv::imwrite(path, actual);
    const cv::Mat expected = cv::imread(path, cv::IMREAD_COLOR);
    ASSERT_EQ(expected.size(), actual.size()) << path;
    const Difference difference = compare(actual, expected);
    const bool same = difference.mean <= 0.5 && difference.max <= 24.0;
    EXPECT_TRUE(same) << "mean " << difference.mean << ", max " << difference.max;
    if (!same) {
        const auto folder = std::filesystem::temp_directory_path();
        cv::Mat shown;
        cv::absdiff(actual, expected, shown);
        cv::imwrite((folder / "golden_actual.png").string(), actual);
        cv::imwrite((folder / "golden_expected.png").string(), expected);
        cv::imwrite((folder / "golden_difference.png").string(), shown);
    }

    // The tolerance must not let wrong images pass: one with the camera 2 cm aside, and one
    // slightly darker.
    const auto moved =
        renderer->render(makeView(camera, lookAt({0.42, 0.3, 1.8}, {3.12, 2.0, 0.7})));
    ASSERT_TRUE(moved);
    const Difference aside = compare(asMat(*moved), expected);
    EXPECT_TRUE(aside.mean > 0.5 || aside.max > 24.0);
    cv::Mat darker;
    expected.convertTo(darker, -1, 0.98);
    EXPECT_GT(compare(darker, expected).mean, 0.5);
}

/// An image of half the width and height, each pixel the mean of four.
cv::Mat halved(const cv::Mat& picture) {
    cv::Mat half;
    cv::resize(picture, half, {picture.cols / 2, picture.rows / 2}, 0, 0, cv::INTER_AREA);
    return half;
}

// Compared with an image of many more pixels, scaled down: more samples come closer to it. Labels
// and depth do not depend on the samples.
TEST_F(PictureGl, MoreLooksAPixelComeCloserToALargePicture) {
    const Scene scene = furnishedRoom();
    const CameraParams camera = goldenCamera();
    const Pose pose = lookAt({0.4, 0.3, 1.8}, {3.1, 2.0, 0.7});
    auto renderer = makeRenderer(scene, camera, /*lit=*/true);
    ASSERT_TRUE(renderer) << describe(renderer.error());
    const auto drawn = [&](const CameraParams& size, Antialias antialias) {
        View view = makeView(size, pose);
        view.antialias = antialias;
        auto target = RenderTarget::create(size.width_px, size.height_px);
        FrameRecord frame;
        EXPECT_TRUE(target);
        if (!target) return frame;
        EXPECT_TRUE(renderer->scene().draw(view, *target));
        frame.width = size.width_px;
        frame.height = size.height_px;
        target->readRgb(frame.rgb);
        target->readDepth(frame.depth_m);
        target->readIds(frame.instance);
        return frame;
    };
    CameraParams large = camera;
    large.width_px *= 4;
    large.height_px *= 4;
    const cv::Mat wanted = halved(halved(asMat(drawn(large, Antialias::Samples8))));
    const FrameRecord edges = drawn(camera, Antialias::Edges);
    const FrameRecord four = drawn(camera, Antialias::Samples4);
    const FrameRecord eight = drawn(camera, Antialias::Samples8);
    const double of_edges = compare(asMat(edges), wanted).mean;
    const double of_four = compare(asMat(four), wanted).mean;
    const double of_eight = compare(asMat(eight), wanted).mean;
    EXPECT_LT(of_four, 0.85 * of_edges);
    EXPECT_LT(of_eight, of_four);
    EXPECT_EQ(four.instance, edges.instance);
    EXPECT_EQ(eight.depth_m, edges.depth_m);
    EXPECT_NE(four.rgb, edges.rgb);
}

// Rasterized images match path traced ones, except for details that the coarse light grid cannot
// represent.
TEST_F(PictureGl, DrawnAndPathTracedPicturesAgree) {
    const Scene scene = furnishedRoom();
    const RayCaster rays(scene);
    const LightRig rig = makeLightRig(scene, rays);
    const LightVolume light = bakeLightVolume(scene, rays, rig);
    CameraParams camera = goldenCamera();
    camera.width_px = 96;
    camera.height_px = 72;
    auto renderer = OffscreenRenderer::create(std::move(context_), scene, light, camera.width_px,
                                              camera.height_px);
    ASSERT_TRUE(renderer) << describe(renderer.error());
    const View view = makeView(camera, lookAt({0.4, 0.3, 1.8}, {3.1, 2.0, 0.7}));
    const auto drawn = renderer->render(view);
    ASSERT_TRUE(drawn);
    PathTracerParams params;
    params.exposure = light.exposure;
    const PathTracer tracer(scene, rays, balanced(rig, light), params);
    LayeredImage image;
    ASSERT_TRUE(tracer.add(view, 32, image));
    FrameRecord traced = *drawn;
    const float scale = light.exposure * std::numbers::pi_v<float>;
    traced.rgb = developed(averaged(image, scale));
    const Difference difference = compare(asMat(*drawn), asMat(traced));
    EXPECT_LT(difference.mean, 12.0);
    // The tolerance would not accept other light.
    traced.rgb = developed(averaged(image, 1.3F * scale));
    EXPECT_GT(compare(asMat(*drawn), asMat(traced)).mean, 12.0);
}

// Glass is transparent in the image, but the labels contain the glass itself.
TEST_F(PictureGl, GlassIsSeenThroughButLabelled) {
    SceneBuilder builder;
    builder.object("wall", {kNyuWall, Role::Structure, {0.8F, 0.1F, 0.1F}})
        .quad({4, -20, -20}, {0, 40, 0}, {0, 0, 40});
    builder.object("pane", {kNyuWindow, Role::Structure, {0.1F, 0.1F, 0.8F}})
        .quad({2, -5, -5}, {0, 10, 0}, {0, 0, 10});
    Scene scene = builder.build();
    scene.materials[1].opacity = 0.2F;
    const CameraParams camera = goldenCamera();
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    const auto frame = renderer->render(makeView(camera, lookAt({0, 0, 0}, {1, 0, 0})));
    ASSERT_TRUE(frame);
    const std::size_t middle = 48UL * 128 + 64;
    EXPECT_EQ(frame->instance[middle], 2);
    EXPECT_NEAR(frame->depth_m[middle], 2.0F, 1e-4F);
    EXPECT_GT(frame->rgb[3 * middle], frame->rgb[3 * middle + 2] + 40);
}

// A glass bowl is visible by its rim. Without a pane (it ends below the image centre) black stays
// black.
TEST_F(PictureGl, GlassReflectsTheMoreItIsLookedAlong) {
    const double none = blackBehindPane(0.0, false);
    const double facing = blackBehindPane(0.0);
    const double slanted = blackBehindPane(70.0);
    const double along = blackBehindPane(85.0);
    EXPECT_GT(facing, none + 5.0);
    EXPECT_LT(facing, none + 60.0);
    EXPECT_GT(slanted, facing + 15.0);
    EXPECT_GT(along, slanted + 30.0);
}

TEST_F(PictureGl, TheOverviewHoldsTheWholeRoomWithoutItsCeiling) {
    const Scene scene = furnishedRoom();
    const RayCaster rays(scene);
    OverviewSettings settings;
    settings.width_px = 240;
    settings.height_px = 150;
    settings.supersampling = 1;
    const View view = overviewOf(scene, settings);
    // The floor's corners are inside the image.
    for (const double x : {0.0, 4.0}) {
        for (const double y : {0.0, 3.0}) {
            const Eigen::Vector2d at = view.intrinsics.project(view.pose.toCamera({x, y, 0.0}));
            EXPECT_TRUE(at.x() > 0 && at.x() < 240 && at.y() > 0 && at.y() < 150);
        }
    }
    CameraParams camera;
    camera.width_px = 240;
    camera.height_px = 150;
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    const auto frame = renderer->render(view);
    ASSERT_TRUE(frame);
    std::vector<int> pixels(scene.objects.size() + 1, 0);
    for (const std::uint16_t id : frame->instance) ++pixels[id];
    for (const Object& object : scene.objects) {
        const int seen = pixels[object.id];
        if (object.nyu40 == kNyuCeiling) {
            EXPECT_EQ(seen, 0);
        }
        if (object.role == Role::Target) {
            EXPECT_GT(seen, 0) << object.name;
        }
    }
}

TEST(OverlayPainter, HiddenLinesAreFaintAndVisibleOnesAreNot) {
    View view;
    CameraParams camera;
    camera.width_px = 64;
    camera.height_px = 48;
    view.intrinsics = makeIntrinsics(camera);
    view.pose = lookAt({0, 0, 0}, {1, 0, 0});
    Overlay overlay;
    overlay.lines.push_back({{3, 2, 0}, {3, -2, 0}, {1, 1, 1, 1}, 3.0});
    // The left half of the image has a surface in front of the line, the right half one behind it.
    std::vector<float> depth(64UL * 48, 2.0F);
    for (std::size_t i = 0; i < depth.size(); ++i) {
        if (i % 64 >= 32) depth[i] = 4.0F;
    }
    std::vector<std::uint8_t> rgb(3UL * 64 * 48, 0);
    paintOverlay(overlay, view, depth, 1.0, rgb);
    const auto at = [&](std::size_t x, std::size_t y) { return rgb[3 * (y * 64 + x)]; };
    EXPECT_EQ(at(50, 24), 255);
    EXPECT_GT(at(14, 24), 20);
    EXPECT_LT(at(14, 24), 90);
    EXPECT_EQ(at(50, 10), 0);
}

}  // namespace
}  // namespace dollytrack::render::picture_gl_test
