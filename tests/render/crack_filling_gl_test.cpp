#include "render/draw/crack_filling.h"

#include "engine/core/random.h"
#include "render/dataset/contents/frame_context.h"
#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::render::crack_filling_gl_test {
namespace {

/// A room of thick boxes stacked on each other: their edges lie on one line but share no corner.
Scene roomOfBoxes() {
    dollytrack::test::SceneBuilder builder;
    const dollytrack::test::SceneBuilder::Look wall{kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}};
    builder.object("floor", wall).box({2, 1.5, -0.05}, {4.0, 3.0, 0.1});
    builder.object("ceiling", wall).box({2, 1.5, 2.65}, {4.0, 3.0, 0.1});
    builder.object("wall_1", wall).box({-0.05, 1.47, 1.3}, {0.1, 3.31, 2.6});
    builder.object("wall_2", wall).box({4.05, 1.52, 1.3}, {0.1, 3.17, 2.6});
    builder.object("wall_3", wall).box({1.97, -0.05, 1.3}, {4.23, 0.1, 2.6});
    builder.object("wall_4", wall).box({2.01, 3.05, 1.3}, {4.37, 0.1, 2.6});
    builder.object("cabinet").box({1, 2.7, 0.4}, {0.83, 0.6, 0.8});
    return builder.build();
}

std::ptrdiff_t unlabelled(const FrameRecord& frame) {
    return std::count(frame.instance.begin(), frame.instance.end(), 0);
}

class CrackFillingGl : public fixture::GlTest {};

// Inside a closed room every pixel shows a surface.
TEST_F(CrackFillingGl, NoPixelOfAClosedRoomShowsNothing) {
    const Scene scene = roomOfBoxes();
    const RayCaster rays(scene);
    const MovingObjects still(scene, rays, {});
    CameraParams camera;
    camera.width_px = 320;
    camera.height_px = 240;
    camera.hfov_deg = 90.0;
    const DatasetContents contents{scene, camera, {}, {}};
    const FrameContext context{contents, still};
    Result<OffscreenRenderer> renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);

    std::ptrdiff_t drawn_as_nothing = 0;
    for (int i = 0; i < 60; ++i) {
        const double angle = 0.37 * i;
        const Eigen::Vector3d eye(2.0 + 0.011 * i, 1.5 - 0.007 * i, 1.2 + 0.013 * i);
        const Eigen::Vector3d target =
            eye + Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.9 * std::sin(1.7 * i));
        const View view = makeView(camera, lookAt(eye, target));
        Result<FrameRecord> frame = renderer->render(view);
        ASSERT_TRUE(frame);
        drawn_as_nothing += unlabelled(*frame);

        const std::vector<CrackPixel> cracks = findCracks(view, frame->instance, rays);
        fillCracks(cracks, context.contents.scene, context.moving, view, *frame);

        EXPECT_EQ(unlabelled(*frame), 0) << "frame " << i;
        for (const CrackPixel& crack : cracks) {
            const auto x = static_cast<double>(crack.pixel % 320) + 0.5;
            const auto y = static_cast<double>(crack.pixel / 320) + 0.5;
            const RayHit hit =
                rays.cast(view.pose.position, view.pose.rotation * view.intrinsics.unproject(x, y));
            EXPECT_EQ(frame->instance[crack.pixel], hit.object_id);
            EXPECT_NEAR(frame->depth_m[crack.pixel], hit.distance, 1e-5);
            EXPECT_TRUE(std::equal(&frame->rgb[3 * crack.pixel], &frame->rgb[3 * crack.pixel] + 3,
                                   &frame->rgb[3 * crack.like]));
        }
    }
    EXPECT_GT(drawn_as_nothing, 0) << "this room has no cracks to be filled";
}

/// A room with boards at eye level, which are seen edge-on.
Scene roomOfBoards() {
    dollytrack::test::SceneBuilder builder;
    const dollytrack::test::SceneBuilder::Look wall{kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}};
    builder.object("floor", wall).box({2, 1.5, -0.05}, {4.0, 3.0, 0.1});
    builder.object("wall_2", wall).box({4.05, 1.52, 1.3}, {0.1, 3.17, 2.6});
    builder.object("wall_4", wall).box({2.01, 3.05, 1.3}, {4.37, 0.1, 2.6});
    for (int i = 0; i < 4; ++i) {
        builder.object("board").box({2.3 + 0.2 * i, 2.5 - 0.3 * i, 1.2},
                                    {1.9, 0.37, 0.002 + 0.01 * i});
    }
    return builder.build();
}

/// Number of pixels whose depth is not found on their object by any ray through them or a hundredth
/// of a pixel beside.
int depthsOfNothing(const FrameRecord& frame, const View& view, const RayCaster& rays) {
    int wrong = 0;
    for (std::size_t pixel = 0; pixel < frame.instance.size(); ++pixel) {
        const double x = static_cast<double>(pixel % static_cast<std::size_t>(frame.width)) + 0.5;
        const double y = static_cast<double>(pixel / static_cast<std::size_t>(frame.width)) + 0.5;
        const double depth = frame.depth_m[pixel];
        bool found = frame.instance[pixel] == 0;
        for (const double down : {0.0, -0.01, 0.01}) {
            for (const double right : {0.0, -0.01, 0.01}) {
                if (found) continue;
                const ViewRay ray = view.rayThrough(x + right, y + down);
                const RayHit hit = rays.cast(ray.origin, ray.direction,
                                             std::numeric_limits<double>::infinity(), view.near_m);
                // Tolerance: half a millimetre for the hundredth of a pixel, and as much for the
                // ray.
                found = hit.object_id == frame.instance[pixel] &&
                        std::abs(hit.distance - depth) <= 0.001 + 1e-4 * depth;
            }
        }
        wrong += found ? 0 : 1;
    }
    return wrong;
}

// Rasterization extrapolates the plane of a board that is seen edge-on beyond its end, by metres.
TEST_F(CrackFillingGl, DepthOfASurfaceSeenAlongItselfIsThatOfItsRay) {
    const Scene scene = roomOfBoards();
    const RayCaster rays(scene);
    const MovingObjects still(scene, rays, {});
    CameraParams camera;
    camera.width_px = 160;
    camera.height_px = 120;
    const DatasetContents contents{scene, camera, {}, {}};
    const FrameContext context{contents, still};
    Result<OffscreenRenderer> renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);

    int drawn_wrong = 0;
    for (int i = 0; i < 40; ++i) {
        const Eigen::Vector3d eye(0.3 + 0.01 * i, 0.4 + 0.013 * i, 1.2 + 0.0005 * (i - 20));
        Pose pose = lookAt(eye, {3.0, 2.4 - 0.03 * i, 1.2 + 0.01 * (i % 7)});
        // Rolled, so that the thin bands of the boards' faces cross the centres of some pixels.
        pose.rotation = pose.rotation * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
        const View view = makeView(camera, pose);
        Result<FrameRecord> frame = renderer->render(view);
        ASSERT_TRUE(frame);
        drawn_wrong += depthsOfNothing(*frame, view, rays);
        std::vector<float> drawn;
        renderer->target().readDrawnDepth(drawn);
        fillCracks(findCracks(view, frame->instance, drawn, rays), context.contents.scene,
                   context.moving, view, *frame);
        EXPECT_EQ(depthsOfNothing(*frame, view, rays), 0) << "frame " << i;
    }
    EXPECT_GT(drawn_wrong, 0) << "nothing here is seen along itself";
}

/// A sloping board with 3,000 triangles on it whose corners lie on one line.
Scene boardWithLines() {
    dollytrack::test::SceneBuilder builder;
    builder.object("board").quad({-1, 1, -1}, {2, 0, 0.3}, {0.2, 2, 1.9});
    Scene scene = builder.build();
    Object& board = scene.objects.front();
    Random random(7);
    for (int i = 0; i < 3000; ++i) {
        const auto place = [&] {
            return Eigen::Vector3d(Eigen::Vector3d(-1, 1, -1) +
                                   random.uniform() * Eigen::Vector3d(2, 0, 0.3) +
                                   random.uniform() * Eigen::Vector3d(0.2, 2, 1.9));
        };
        const Eigen::Vector3d from = place();
        const Eigen::Vector3d to = place();
        const Eigen::Vector3d between = from + random.uniform() * (to - from);
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        for (const Eigen::Vector3d& corner : {from, to, between}) {
            scene.positions.push_back(corner.cast<float>());
            scene.normals.push_back(scene.normals.front());
            scene.uvs.emplace_back(0.0F, 0.0F);
        }
        scene.triangles.push_back({first, first + 1, first + 2});
        scene.triangle_material.push_back(scene.triangle_material.front());
    }
    board.vertex_count = static_cast<std::uint32_t>(scene.positions.size());
    board.triangle_count = static_cast<std::uint32_t>(scene.triangles.size());
    return scene;
}

// The rasterised depth of a degenerate triangle is arbitrary.
TEST_F(CrackFillingGl, DegenerateTrianglesAreNotDrawn) {
    const Scene scene = boardWithLines();
    const RayCaster rays(scene);
    CameraParams camera;
    camera.width_px = 320;
    camera.height_px = 240;
    Result<OffscreenRenderer> renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    for (int i = 0; i < 10; ++i) {
        const View view = makeView(camera, lookAt({0.1 * i - 0.5, -0.7, 0.05 * i}, {0, 1.8, 0}));
        Result<FrameRecord> frame = renderer->render(view);
        ASSERT_TRUE(frame);
        EXPECT_GT(std::ranges::count(frame->instance, 1), 10000);
        EXPECT_EQ(depthsOfNothing(*frame, view, rays), 0) << "frame " << i;
    }
}

// Thin triangles along an outline get depths that are millimetres off.
TEST_F(CrackFillingGl, PixelsBesideAnOutlineShowWhatTheirRaysHit) {
    const Scene scene = dollytrack::test::furnishedRoom();
    const RayCaster rays(scene);
    const MovingObjects still(scene, rays, {});
    CameraParams camera;
    camera.width_px = 320;
    camera.height_px = 240;
    const DatasetContents contents{scene, camera, {}, {}};
    const FrameContext context{contents, still};
    Result<OffscreenRenderer> renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    constexpr double kTolerance_m = 2e-5;
    int beside = 0;
    int drawn_off = 0;
    for (int i = 0; i < 10; ++i) {
        const View view = makeView(
            camera, lookAt({0.4 + 0.3 * i, 0.5, 1.2 + 0.07 * i}, {2.0, 1.9 - 0.1 * i, 0.6}));
        Result<FrameRecord> frame = renderer->render(view);
        ASSERT_TRUE(frame);
        std::vector<float> drawn;
        renderer->target().readDrawnDepth(drawn);
        const std::vector<std::uint16_t> labels = frame->instance;
        const std::vector<float> before = frame->depth_m;
        fillCracks(findCracks(view, labels, drawn, rays), context.contents.scene, context.moving,
                   view, *frame);
        for (std::size_t pixel = 0; pixel + 320 < labels.size(); ++pixel) {
            if (labels[pixel] == labels[pixel + 320]) continue;
            ++beside;
            const ViewRay ray = view.rayThrough(static_cast<double>(pixel % 320) + 0.5,
                                                static_cast<double>(pixel / 320) + 0.5);
            const RayHit hit = rays.cast(ray.origin, ray.direction,
                                         std::numeric_limits<double>::infinity(), view.near_m);
            drawn_off += std::abs(before[pixel] - hit.distance) > kTolerance_m;
            EXPECT_NEAR(frame->depth_m[pixel], hit.distance, kTolerance_m) << "frame " << i;
        }
    }
    EXPECT_GT(beside, 1000);
    EXPECT_GT(drawn_off, 0) << "no drawn depth beside an outline is off";
}

/// A cupboard's front of two rows of boards whose edges lie on one line but share no corner, with
/// the back of the boards 3 mm behind, all of one object.
Scene frontOfBoards() {
    dollytrack::test::SceneBuilder builder;
    auto& front = builder.object("front");
    const Eigen::Vector3d along(std::cos(0.2), 0.0, std::sin(0.2));
    const Eigen::Vector3d up(-std::sin(0.2), 0.0, std::cos(0.2));
    const auto addRow = [&](double width_m, double bottom_m) {
        for (double at = -1.0; at < 1.0; at += width_m) {
            front.quad(at * along + bottom_m * up, width_m * along, up);
        }
    };
    addRow(0.137, 0.0);
    addRow(0.171, -1.0);
    front.quad({-3.0, 0.003, -3.0}, {6.0, 0.0, 0.0}, {0.0, 0.0, 6.0});
    return builder.build();
}

TEST_F(CrackFillingGl, NoCrackShowsAnotherSurfaceOfTheSameObjectCloseBehind) {
    const Scene scene = frontOfBoards();
    const RayCaster rays(scene);
    const MovingObjects still(scene, rays, {});
    CameraParams camera;
    camera.width_px = 320;
    camera.height_px = 240;
    Result<OffscreenRenderer> renderer = makeRenderer(scene, camera);
    ASSERT_TRUE(renderer);
    int drawn_wrong = 0;
    for (int i = 0; i < 100; ++i) {
        const View view = makeView(
            camera, lookAt({0.013 * i - 0.7, -1.1, 0.31 - 0.004 * i}, {0.01 * i - 0.5, 0.0, 0.0}));
        Result<FrameRecord> frame = renderer->render(view);
        ASSERT_TRUE(frame);
        drawn_wrong += depthsOfNothing(*frame, view, rays);
        std::vector<float> drawn;
        renderer->target().readDrawnDepth(drawn);
        fillCracks(findCracks(view, frame->instance, drawn, rays), scene, still, view, *frame);
        EXPECT_EQ(depthsOfNothing(*frame, view, rays), 0) << "frame " << i;
    }
    EXPECT_GT(drawn_wrong, 0) << "these boards have no cracks to be filled";
}

// Open areas and the corner of a window must not be filled as cracks.
TEST_F(CrackFillingGl, WhatIsOpenStaysOpen) {
    dollytrack::test::SceneBuilder builder;
    builder.object("post").box({0, 2, 0}, {0.2, 0.2, 4});
    const Scene scene = builder.build();
    const RayCaster rays(scene);
    CameraParams camera;
    camera.width_px = 64;
    camera.height_px = 48;
    const View view = makeView(camera, lookAt({0, 0, 0}, {0, 2, 0}));
    std::vector<std::uint16_t> labels(64 * 48, 1);
    labels[10 * 64 + 5] = 0;   // beside the post, where rays meet nothing
    labels[24 * 64 + 32] = 0;  // on it
    const std::vector<CrackPixel> cracks = findCracks(view, labels, rays);
    ASSERT_EQ(cracks.size(), 1U);
    EXPECT_EQ(cracks[0].pixel, 24U * 64 + 32);
    EXPECT_EQ(labels[cracks[0].like], 1);
}

}  // namespace
}  // namespace dollytrack::render::crack_filling_gl_test
