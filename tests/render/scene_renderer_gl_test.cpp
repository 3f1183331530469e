#include "render/draw/scene_renderer.h"

#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

#include <limits>
#include <numeric>
#include <vector>

namespace dollytrack::render::scene_renderer_gl_test {
namespace {

using dollytrack::test::furnishedRoom;
using dollytrack::test::SceneBuilder;

class SceneRendererGl : public fixture::GlTest {};

CameraParams smallCamera() {
    CameraParams camera;
    camera.width_px = 160;
    camera.height_px = 120;
    return camera;
}

TEST_F(SceneRendererGl, AWallAtFourMetresReadsFourMetresForEveryNearPlane) {
    SceneBuilder builder;
    builder.object("wall").quad({4, -20, -20}, {0, 40, 0}, {0, 0, 40});
    const Scene scene = builder.build();
    const CameraParams camera = smallCamera();
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer) << describe(renderer.error());
    for (const double near_m : {0.001, 0.01, 0.05, 0.5, 3.9}) {
        View view = makeView(camera, lookAt({0, 0, 0}, {1, 0, 0}));
        view.near_m = near_m;
        const auto frame = renderer->render(view);
        ASSERT_TRUE(frame) << describe(frame.error());
        for (const float depth : frame->depth_m) ASSERT_NEAR(depth, 4.0F, 2e-5F) << near_m;
        for (const std::uint16_t id : frame->instance) ASSERT_EQ(id, 1);
    }
}

TEST_F(SceneRendererGl, TheNearPlaneCutsWhatIsCloser) {
    SceneBuilder builder;
    builder.object("wall").quad({4, -20, -20}, {0, 40, 0}, {0, 0, 40});
    const Scene scene = builder.build();
    const CameraParams camera = smallCamera();
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    View view = makeView(camera, lookAt({0, 0, 0}, {1, 0, 0}));
    view.near_m = 4.1;
    const auto frame = renderer->render(view);
    ASSERT_TRUE(frame);
    for (const float depth : frame->depth_m) ASSERT_EQ(depth, 0.0F);
    for (const std::uint16_t id : frame->instance) ASSERT_EQ(id, 0);
}

// Seen from above with 20 px per metre, a box of 2 x 1 x 0.5 m covers 40 x 20 px at any position
// and height; its top is 0.5 m nearer than the floor.
TEST_F(SceneRendererGl, AnOrthographicViewKeepsSizesAndMeasuresDepthAlongItsAxis) {
    SceneBuilder builder;
    builder.object("floor").quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0});
    builder.object("box").box({1.0, 0.5, 0.25}, {2.0, 1.0, 0.5});
    const Scene scene = builder.build();
    const CameraParams camera = smallCamera();
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer) << describe(renderer.error());
    for (const double height : {3.0, 40.0}) {
        View view = makeView(camera, lookAt({0, 0, height}, {0, 0, 0}));
        view.orthographic = Orthographic{20.0, 100.0};
        const auto frame = renderer->render(view);
        ASSERT_TRUE(frame) << describe(frame.error());
        int boxes = 0;
        for (int y = 0; y < camera.height_px; ++y) {
            for (int x = 0; x < camera.width_px; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * camera.width_px + x;
                // Looking straight down, the camera's x axis is the world's; rows go towards -y.
                const double east = (x + 0.5 - 80.0) / 20.0;
                const double north = -(y + 0.5 - 60.0) / 20.0;
                const bool on_box = east > 0.0 && east < 2.0 && north > 0.0 && north < 1.0;
                ASSERT_EQ(frame->instance[i], on_box ? 2 : 1) << x << ' ' << y;
                ASSERT_NEAR(frame->depth_m[i], height - (on_box ? 0.5 : 0.0), 1e-4);
                boxes += on_box;
            }
        }
        EXPECT_EQ(boxes, 40 * 20);
        ASSERT_TRUE(renderer->scene().startSilhouettes(view, std::vector<int>{2}));
        EXPECT_EQ(renderer->scene().finishSilhouettes().at(0), 40U * 20U);
    }
}

// The first image of a scene: no textures, no simplified meshes, no ambient occlusion, which only
// darkens.
TEST_F(SceneRendererGl, APlainSceneHasTheSameGeometryWithoutOcclusion) {
    const Scene scene = furnishedRoom();
    const CameraParams camera = smallCamera();
    auto whole = makeRenderer(scene, camera);
    ASSERT_TRUE(whole) << describe(whole.error());
    View view = makeView(camera, lookAt({0.5, 0.5, 1.6}, {3, 2, 0.5}));
    const auto expected = whole->render(view);
    ASSERT_TRUE(expected) << describe(expected.error());

    LightVolume light;
    light.cells = {1, 1, 1};
    light.ambient.assign(1, Eigen::Vector3f::Ones());
    light.lamps.assign(1, Eigen::Vector3f::Zero());
    auto plain = SceneRenderer::create(scene, light, Detail::Plain);
    auto target = RenderTarget::create(camera.width_px, camera.height_px);
    ASSERT_TRUE(plain && target);
    view.coarse = true;
    ASSERT_TRUE(plain->draw(view, *target));
    std::vector<float> depth_m;
    std::vector<std::uint16_t> ids;
    std::vector<std::uint8_t> rgb;
    target->readDepth(depth_m);
    target->readIds(ids);
    target->readRgb(rgb);
    EXPECT_EQ(depth_m, expected->depth_m);
    EXPECT_EQ(ids, expected->instance);
    EXPECT_GT(std::accumulate(rgb.begin(), rgb.end(), 0L),
              std::accumulate(expected->rgb.begin(), expected->rgb.end(), 0L));
}

TEST_F(SceneRendererGl, AnOrthographicViewMeetsTheRayOfEachPixel) {
    const Scene scene = furnishedRoom();
    const RayCaster rays(scene);
    const CameraParams camera = smallCamera();
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer) << describe(renderer.error());
    View view = makeView(camera, lookAt({2.0, 1.5, 2.4}, {1.5, 1.0, 0.3}));
    view.orthographic = Orthographic{60.0, 50.0};
    view.intrinsics.cx += 12.5;
    const auto frame = renderer->render(view);
    ASSERT_TRUE(frame) << describe(frame.error());
    int wrong = 0;
    for (int y = 0; y < camera.height_px; ++y) {
        for (int x = 0; x < camera.width_px; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * camera.width_px + x;
            const ViewRay ray = view.rayThrough(x + 0.5, y + 0.5);
            const RayHit hit = rays.cast(ray.origin, ray.direction,
                                         std::numeric_limits<double>::infinity(), view.near_m);
            const bool same = frame->instance[i] == hit.object_id &&
                              std::abs(frame->depth_m[i] - hit.distance) < 1e-3;
            wrong += hit.object_id != 0 && !same;
            if (hit.object_id == 0) continue;
            const Eigen::Vector3d at =
                view.pose.toCamera(ray.origin + hit.distance * ray.direction);
            EXPECT_NEAR(at.z(), hit.distance, 1e-9);
            EXPECT_NEAR((view.project(at) - Eigen::Vector2d(x + 0.5, y + 0.5)).norm(), 0.0, 1e-9);
        }
    }
    EXPECT_LT(wrong, 200);  // along edges, of 19200
}

/// Number of pixels whose neighbourhood is a single object by ray casting, and how many of them
/// disagree.
struct Agreement {
    int compared = 0;
    int wrong_id = 0;
    double worst_depth_m = 0.0;
};

Agreement compareWithRays(const RayCaster& rays, const View& view, const FrameRecord& frame) {
    const int width = frame.width;
    std::vector<RayHit> hits(frame.instance.size());
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Eigen::Vector3d way =
                view.pose.rotation * view.intrinsics.unproject(x + 0.5, y + 0.5);
            hits[static_cast<std::size_t>(y) * width + x] = rays.cast(view.pose.position, way);
        }
    }
    Agreement result;
    for (int y = 1; y + 1 < frame.height; ++y) {
        for (int x = 1; x + 1 < width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * width + x;
            bool edge = false;
            for (int k = 0; k < 9; ++k) {
                const RayHit& other = hits[i + (k / 3 - 1) * width + (k % 3 - 1)];
                edge = edge || other.object_id != hits[i].object_id;
            }
            if (edge) continue;
            ++result.compared;
            if (hits[i].object_id != frame.instance[i]) ++result.wrong_id;
            result.worst_depth_m =
                std::max(result.worst_depth_m, std::abs(hits[i].distance - frame.depth_m[i]));
        }
    }
    return result;
}

TEST_F(SceneRendererGl, IdsAndDepthAgreeWithRaysThroughPixelCentres) {
    const Scene scene = furnishedRoom();
    const RayCaster rays(scene);
    const CameraParams camera = smallCamera();
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    for (const Eigen::Vector3d& target :
         {Eigen::Vector3d(3.3, 1.5, 0.7), {0.5, 1.5, 0.4}, {1.8, 3.0, 1.5}, {3.9, 0.1, 2.5}}) {
        const View view = makeView(camera, lookAt({1.9, 1.1, 1.4}, target));
        const auto frame = renderer->render(view);
        ASSERT_TRUE(frame);
        const Agreement agreement = compareWithRays(rays, view, *frame);
        EXPECT_GT(agreement.compared, 15'000);
        EXPECT_EQ(agreement.wrong_id, 0);
        EXPECT_LT(agreement.worst_depth_m, 2e-3);
    }
}

// The comparison above must detect a shift of half a pixel.
TEST_F(SceneRendererGl, TheRayComparisonNoticesAnotherPose) {
    const Scene scene = furnishedRoom();
    const RayCaster rays(scene);
    const CameraParams camera = smallCamera();
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    const View view = makeView(camera, lookAt({1.9, 1.1, 1.4}, {3.3, 1.5, 0.7}));
    const auto frame = renderer->render(view);
    ASSERT_TRUE(frame);
    View moved = view;
    moved.intrinsics.cx += 0.5;
    EXPECT_GT(compareWithRays(rays, moved, *frame).worst_depth_m, 2e-3);
}

TEST_F(SceneRendererGl, RowZeroIsTheTopAndColumnZeroTheLeft) {
    SceneBuilder builder;
    builder.object("left_top").box({4, 1, 1}, {0.5, 0.5, 0.5});
    builder.object("right_bottom").box({4, -1, -1}, {0.5, 0.5, 0.5});
    const Scene scene = builder.build();
    const CameraParams camera = smallCamera();
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    const auto frame = renderer->render(makeView(camera, lookAt({0, 0, 0}, {1, 0, 0})));
    ASSERT_TRUE(frame);
    const auto at = [&](int x, int y) {
        return frame->instance[static_cast<std::size_t>(y) * camera.width_px + x];
    };
    EXPECT_EQ(at(80 - 35, 60 - 35), 1);
    EXPECT_EQ(at(80 + 35, 60 + 35), 2);
    EXPECT_EQ(at(80, 60), 0);
}

// A box half hidden by another: the hidden fraction follows from similar triangles.
TEST_F(SceneRendererGl, SilhouettesIgnoreOccluders) {
    SceneBuilder builder;
    builder.object("behind").quad({4, -0.5, -0.5}, {0, 1, 0}, {0, 0, 1});
    builder.object("before").quad({2, 0, -2}, {0, 2, 0}, {0, 0, 4});
    const Scene scene = builder.build();
    CameraParams camera;  // 640 x 480, 60 degrees
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    const View view = makeView(camera, lookAt({0, 0, 0}, {1, 0, 0}));
    const auto frame = renderer->render(view);
    ASSERT_TRUE(frame);
    const std::vector<int> ids = {1, 2};
    ASSERT_TRUE(renderer->scene().startSilhouettes(view, ids));
    const std::vector<std::uint64_t> whole = renderer->scene().finishSilhouettes();
    const double side_px = view.intrinsics.fx / 4.0;
    EXPECT_NEAR(static_cast<double>(whole[0]), side_px * side_px, 2.0 * side_px);
    const auto visible = std::count(frame->instance.begin(), frame->instance.end(), 1);
    EXPECT_NEAR(static_cast<double>(visible) / static_cast<double>(whole[0]), 0.5, 0.01);
}

// The same box counted where it fits into the image and where most of it lies outside.
TEST_F(SceneRendererGl, SilhouettesReachBeyondTheImage) {
    SceneBuilder builder;
    builder.object("panel").quad({2, -0.5, -0.5}, {0, 1, 0}, {0, 0, 1});
    builder.object("beside").quad({2, 1.0, -0.5}, {0, 1, 0}, {0, 0, 1});
    builder.object("huge").quad({1, -2.0, -1.5}, {0, 4, 0}, {0, 0, 3});
    const Scene scene = builder.build();
    const CameraParams camera;
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    const View view = makeView(camera, lookAt({0, 0, 0}, {1, 0, 0}));
    const std::vector<int> ids = {1, 2, 3, 1};
    ASSERT_TRUE(renderer->scene().startSilhouettes(view, ids));
    const std::vector<std::uint64_t> whole = renderer->scene().finishSilhouettes();
    const double side_px = view.intrinsics.fx / 2.0;
    EXPECT_NEAR(static_cast<double>(whole[0]), side_px * side_px, 2.0 * side_px);
    EXPECT_NEAR(static_cast<double>(whole[1]), side_px * side_px, 2.0 * side_px);
    const double fx = view.intrinsics.fx;
    EXPECT_NEAR(static_cast<double>(whole[2]), 4.0 * fx * 3.0 * fx, 8.0 * fx);
    EXPECT_EQ(whole[0], whole[3]);
}

// Orthographic views have another depth buffer: several samples per pixel must give the same image.
TEST_F(SceneRendererGl, SeveralLooksAtAnOrthographicViewAgreeWithOne) {
    const Scene scene = furnishedRoom();
    const CameraParams camera = smallCamera();
    auto renderer = makeRenderer(scene, camera, /*lit=*/true);
    ASSERT_TRUE(renderer) << describe(renderer.error());
    View view = makeView(camera, lookAt({2.0, 1.5, 2.4}, {1.5, 1.0, 0.3}));
    view.orthographic = Orthographic{60.0, 50.0};
    const auto drawn = [&](Antialias antialias) {
        view.antialias = antialias;
        std::vector<std::uint8_t> rgb;
        EXPECT_TRUE(renderer->scene().draw(view, renderer->target()));
        renderer->target().readRgb(rgb);
        return rgb;
    };
    const auto apart = [](const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(int{a[i]} - int{b[i]});
        return sum / static_cast<double>(a.size());
    };
    const std::vector<std::uint8_t> once = drawn(Antialias::Edges);
    EXPECT_LT(apart(once, drawn(Antialias::Samples4)), 2.0);
    EXPECT_LT(apart(once, drawn(Antialias::Samples8)), 2.0);
    view.pose = lookAt({2.3, 1.5, 2.4}, {1.8, 1.0, 0.3});
    EXPECT_GT(apart(once, drawn(Antialias::Samples4)), 4.0);
}

// The silhouette of a floor that is far larger than the image agrees with similar triangles within
// 0.2 %. The part inside the image is that of the labels, so a floor that ends there is counted
// exactly.
TEST_F(SceneRendererGl, SilhouettesOfManyImagesAreCountedInPart) {
    SceneBuilder builder;
    builder.object("inside").quad({1, -0.3, -0.2}, {0, 0.6, 0}, {0, 0, 0.4});
    builder.quad({-1, -1, -1}, {0, 2, 0}, {0, 0, 2});  // behind: its box is beyond all limits
    builder.object("huge").quad({2, -6.0, -0.8}, {0, 6.2, 0}, {0, 0, 4.8});
    builder.quad({-1, -1, -1}, {0, 2, 0}, {0, 0, 2});
    const Scene scene = builder.build();
    const CameraParams camera;
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    View view = makeView(camera, lookAt({0, 0, 0}, {1, 0, 0}));
    view.intrinsics.width -= 3;  // not a multiple of the steps
    view.intrinsics.height -= 1;
    const std::vector<int> ids = {1, 2};
    ASSERT_TRUE(renderer->scene().startSilhouettes(view, ids));
    const std::vector<std::uint64_t> whole = renderer->scene().finishSilhouettes();
    const double fx = view.intrinsics.fx;
    const auto frame = renderer->render(makeView(camera, view.pose));
    ASSERT_TRUE(frame);
    EXPECT_EQ(static_cast<std::ptrdiff_t>(whole[0]),
              std::count(frame->instance.begin(), frame->instance.end(), 1));
    EXPECT_NEAR(static_cast<double>(whole[1]), 3.1 * fx * 2.4 * fx, 0.002 * 3.1 * fx * 2.4 * fx);
}

// Overlapping layers of one object count once.
TEST_F(SceneRendererGl, SilhouettesCountEachPixelOnce) {
    SceneBuilder builder;
    builder.object("stack");
    for (int i = 0; i < 5; ++i) builder.quad({2.0 + i, -0.5, -0.5}, {0, 1, 0}, {0, 0, 1});
    const Scene scene = builder.build();
    const CameraParams camera;
    auto renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    const View view = makeView(camera, lookAt({0, 0, 0}, {1, 0, 0}));
    const std::vector<int> ids = {1};
    ASSERT_TRUE(renderer->scene().startSilhouettes(view, ids));
    const double side_px = view.intrinsics.fx / 2.0;
    EXPECT_NEAR(static_cast<double>(renderer->scene().finishSilhouettes()[0]), side_px * side_px,
                2.0 * side_px);
}

}  // namespace
}  // namespace dollytrack::render::scene_renderer_gl_test
