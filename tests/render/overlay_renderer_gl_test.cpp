#include "render/overlays/overlay_renderer.h"

#include "render/overlays/overlay_painter.h"
#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

#include <array>

namespace dollytrack::render::overlay_renderer_gl_test {
namespace {

using dollytrack::test::SceneBuilder;

constexpr int kWidth = 200;
constexpr int kHeight = 150;
const Eigen::Vector4f kRed(1, 0, 0, 1);

/// A grey wall at x = 4 with nothing in front of it; the camera at the origin looks along x.
class OverlayRendererGl : public fixture::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!context_) return;
        SceneBuilder builder;
        builder.object("wall").quad({4, -20, -20}, {0, 40, 0}, {0, 0, 40});
        scene_ = builder.build();
        CameraParams camera;
        camera.width_px = kWidth;
        camera.height_px = kHeight;
        auto renderer = makeRenderer(scene_, camera);
        ASSERT_TRUE(renderer) << describe(renderer.error());
        renderer_.emplace(std::move(*renderer));
        view_ = makeView(camera, lookAt({0, 0, 0}, {1, 0, 0}));
        auto overlays = OverlayRenderer::create();
        ASSERT_TRUE(overlays) << describe(overlays.error());
        overlays_.emplace(std::move(*overlays));
        auto canvas = OverlayCanvas::create(kWidth, kHeight);
        ASSERT_TRUE(canvas) << describe(canvas.error());
        canvas_.emplace(std::move(*canvas));
        buffers_.emplace();
    }
    void TearDown() override {
        // OpenGL objects are destroyed before their context.
        buffers_.reset();
        canvas_.reset();
        overlays_.reset();
    }

    /// Draws the image with the overlay; `plain_` is the image without it.
    void draw(const Overlay& overlay, float hidden_opacity = 0.25F) {
        ASSERT_TRUE(renderer_->scene().draw(view_, renderer_->target()));
        renderer_->target().readRgb(plain_);
        buffers_->upload(overlay);
        const std::array<OverlayLayer, 1> layers = {{{&*buffers_, 1.0F, hidden_opacity}}};
        const Status status = overlays_->draw(layers, view_, renderer_->target(), *canvas_);
        ASSERT_TRUE(status) << describe(status.error());
        canvas_->readRgb(drawn_);
    }

    /// How far a pixel changed from the plain image to pure red, 0..1, measured by its green
    /// channel.
    [[nodiscard]] double cover(int x, int y) const {
        const std::size_t i = 3 * (static_cast<std::size_t>(y) * kWidth + x) + 1;
        return plain_[i] == 0 ? 0.0 : 1.0 - double(drawn_[i]) / plain_[i];
    }
    /// Sum of cover() over one column: the width of a horizontal line, px.
    [[nodiscard]] double columnCover(int x) const {
        double sum = 0.0;
        for (int y = 0; y < kHeight; ++y) sum += cover(x, y);
        return sum;
    }
    [[nodiscard]] double totalCover() const {
        double sum = 0.0;
        for (int x = 0; x < kWidth; ++x) sum += columnCover(x);
        return sum;
    }

    Scene scene_;
    View view_;
    std::optional<OffscreenRenderer> renderer_;
    std::optional<OverlayRenderer> overlays_;
    std::optional<OverlayCanvas> canvas_;
    std::optional<OverlayBuffers> buffers_;
    std::vector<std::uint8_t> plain_;
    std::vector<std::uint8_t> drawn_;
};

TEST_F(OverlayRendererGl, NothingChangesThePictureInNothing) {
    draw({});
    EXPECT_EQ(plain_, drawn_);
    EXPECT_TRUE(buffers_->empty());
}

TEST_F(OverlayRendererGl, ALineKeepsItsWidthWhateverItsDistance) {
    for (const double x : {0.5, 1.0, 3.5}) {
        Overlay overlay;
        overlay.lines.push_back({{x, -5, 0.01}, {x, 5, 0.01}, kRed, 1.6});
        draw(overlay);
        EXPECT_NEAR(columnCover(50), 1.6, 0.15) << x;
        EXPECT_NEAR(columnCover(150), 1.6, 0.15) << x;
    }
}

TEST_F(OverlayRendererGl, ALineBehindAWallIsFaint) {
    Overlay overlay;
    overlay.lines.push_back({{5, -9, 0}, {5, 9, 0}, kRed, 6.0});
    draw(overlay, 0.25F);
    EXPECT_NEAR(cover(100, 75), 0.25, 0.01);
    draw(overlay, 0.0F);
    EXPECT_EQ(plain_, drawn_);
    // The same line in front of the wall: fully opaque.
    overlay.lines[0].a.x() = overlay.lines[0].b.x() = 3.0;
    draw(overlay, 0.25F);
    EXPECT_NEAR(cover(100, 75), 1.0, 0.01);
}

TEST_F(OverlayRendererGl, ALineThroughAWallIsFaintFromThereOn) {
    // The depth at a pixel must be interpolated with perspective, not linearly from end to end.
    Overlay overlay;
    overlay.lines.push_back({{2, 0.8, 0}, {12, -4.8, 0}, kRed, 6.0});
    draw(overlay, 0.25F);
    const double share = (4.0 / 0.99 - 2.0) / 10.0;
    const Eigen::Vector3d crossing =
        Eigen::Vector3d(2, 0.8, 0) + share * Eigen::Vector3d(10, -5.6, 0);
    const double at = view_.project(view_.pose.toCamera(crossing)).x();
    EXPECT_NEAR(cover(static_cast<int>(at) - 2, 75), 1.0, 0.01);
    EXPECT_NEAR(cover(static_cast<int>(at) + 2, 75), 0.25, 0.01);
}

TEST_F(OverlayRendererGl, NothingIsDrawnOutsideTheClippingBox) {
    Overlay overlay;
    overlay.lines.push_back({{3, -9, 0.5}, {3, 9, 0.5}, kRed, 4.0});
    overlay.marks.push_back({{3, 0.2, 0}, OverlayMark::Shape::Square, kRed, 20.0});
    overlay.marks.push_back({{3, 1, 0}, OverlayMark::Shape::Square, kRed, 20.0});
    overlay.boxes.push_back({{3, 0, -0.5}, {0.1, 2.0, 0.1}, kRed});
    overlay.triangles.push_back({{3, -9, -0.9}, {3, 9, -0.9}, {3, 0, -1.0}, kRed});
    const auto coverAt = [&](const Eigen::Vector3d& place) {
        const Eigen::Vector2d pixel = view_.project(view_.pose.toCamera(place));
        return cover(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
    };
    const auto expectAt = [&](double y, bool drawn) {
        for (const double z : {0.5, -0.5, -0.93}) {
            EXPECT_EQ(coverAt({3, y, z}) > 0.9, drawn) << y << " " << z;
        }
    };
    draw(overlay);
    expectAt(0.0, true);
    expectAt(0.8, true);
    EXPECT_GT(coverAt({3, 1, 0}), 0.9);
    view_.clip_box = Eigen::AlignedBox3d(Eigen::Vector3d(0, -0.6, -2), Eigen::Vector3d(5, 0.6, 2));
    draw(overlay);
    expectAt(0.0, true);
    expectAt(-0.55, true);
    expectAt(0.65, false);
    expectAt(-0.65, false);
    EXPECT_GT(coverAt({3, 0.2, 0}), 0.9);
    EXPECT_EQ(coverAt({3, 1, 0}), 0.0);
    view_.clip_box.reset();
    draw(overlay);
    expectAt(0.8, true);
}

TEST_F(OverlayRendererGl, ALineIsCutAtTheNearPlane) {
    Overlay overlay;
    overlay.lines.push_back({{-6, 0, -0.5}, {3, 0, -0.5}, kRed, 4.0});
    overlay.lines.push_back({{-6, 1, 0}, {-1, 1, 0}, kRed, 4.0});
    draw(overlay);
    // From its far end the line runs straight down out of the image.
    const int end = static_cast<int>(view_.project(view_.pose.toCamera({3, 0, -0.5})).y());
    EXPECT_NEAR(cover(100, end + 4), 1.0, 0.01);
    EXPECT_NEAR(cover(100, kHeight - 1), 1.0, 0.01);
    EXPECT_EQ(cover(100, end - 6), 0.0);
}

TEST_F(OverlayRendererGl, TranslucentLinesThatJoinShowNoBeads) {
    Overlay overlay;
    const Eigen::Vector4f faint(1, 0, 0, 0.5);
    for (int i = -20; i < 20; ++i) {
        overlay.lines.push_back({{2, 0.1 * i, 0}, {2, 0.1 * (i + 1), 0}, faint, 5.0});
    }
    draw(overlay);
    for (int x = 20; x < 180; ++x) EXPECT_NEAR(cover(x, 75), 0.5, 0.02) << x;
}

TEST_F(OverlayRendererGl, DashesCoverHalfOfALine) {
    Overlay overlay;
    overlay.lines.push_back({{2, 20, 0}, {2, -20, 0}, kRed, 4.0});
    draw(overlay);
    const double solid = totalCover();
    overlay.lines[0].dash_px = 8.0;
    draw(overlay);
    EXPECT_NEAR(totalCover() / solid, 0.5, 0.12);
}

TEST_F(OverlayRendererGl, ADotHasItsSizeAndItsPlace) {
    for (const double distance : {1.0, 3.0}) {
        Overlay overlay;
        overlay.marks.push_back({{distance, 0, 0}, OverlayMark::Shape::Dot, kRed, 20.0});
        draw(overlay);
        for (const int away : {0, 5, 8}) {
            EXPECT_NEAR(cover(100 + away, 75), 1.0, 0.01) << away;
            EXPECT_NEAR(cover(100, 75 - away), 1.0, 0.01) << away;
        }
        // Outside the rim nothing is drawn.
        EXPECT_EQ(cover(113, 75), 0.0);
        EXPECT_EQ(cover(100 + 9, 75 + 9), 0.0);
    }
}

TEST_F(OverlayRendererGl, SignsDiffer) {
    // Whether the middle, a place aslant of it, and the right and the left are covered.
    const auto coverOf = [&](OverlayMark::Shape shape) {
        Overlay overlay;
        // To the right on the screen is -y in the world.
        overlay.marks.push_back({{3, 0, 0}, shape, kRed, 24.0, {0, -1, 0}});
        draw(overlay);
        return std::array<bool, 4>{cover(100, 75) > 0.9, cover(105, 80) > 0.9, cover(109, 75) > 0.9,
                                   cover(90, 75) > 0.9};
    };
    using Shape = OverlayMark::Shape;
    EXPECT_EQ(coverOf(Shape::Dot), (std::array<bool, 4>{true, true, true, true}));
    EXPECT_EQ(coverOf(Shape::Cross), (std::array<bool, 4>{true, true, false, false}));
    EXPECT_EQ(coverOf(Shape::Ring), (std::array<bool, 4>{false, false, true, true}));
    EXPECT_EQ(coverOf(Shape::Square), (std::array<bool, 4>{true, true, true, true}));
    EXPECT_EQ(coverOf(Shape::Arrow), (std::array<bool, 4>{true, false, true, false}));
}

TEST_F(OverlayRendererGl, ABoxInAnOrthographicViewCoversItsPixels) {
    view_.orthographic = Orthographic{20.0, 100.0};
    Overlay overlay;
    OverlayBox box;
    box.center = {2, -1, 0.5};
    box.half_size = {0.5, 1.0, 0.25};
    box.rgba = {1, 0, 0, 0.5};
    overlay.boxes.push_back(box);
    draw(overlay);
    // y from -2 to 0 lies at columns 100 to 140, z from 0.25 to 0.75 at rows 60 to 70.
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const bool inside = x >= 100 && x < 140 && y >= 60 && y < 70;
            ASSERT_EQ(cover(x, y) > 0.0, inside) << x << ' ' << y;
        }
    }
    EXPECT_NEAR(cover(120, 65), 0.5, 0.02);
}

TEST_F(OverlayRendererGl, BoxesBehindOneAnotherTintOnceInAnyOrder) {
    Overlay overlay;
    for (const double x : {3.0, 1.0, 2.0}) {
        OverlayBox box;
        box.center = {x, 0, 0};
        box.half_size = {0.1, 1, 1};
        box.rgba = {1, 0, 0, 0.4};
        overlay.boxes.push_back(box);
    }
    overlay.triangles.push_back({{1.5, -3, -3}, {1.5, 3, -3}, {1.5, 0, 3}, {1, 0, 0, 0.7}});
    draw(overlay);
    EXPECT_NEAR(cover(100, 75), 0.4, 0.02);
    // Seen from behind, the inner faces of the boxes would be visible; they are not drawn.
    overlay.boxes[1].center.x() = 0.0;
    draw(overlay);
    EXPECT_NEAR(cover(100, 75), 0.7, 0.02);
}

TEST_F(OverlayRendererGl, OneSidedTrianglesAreNotDrawnFromBehind) {
    Overlay overlay;
    // Its front faces the camera, which looks along x.
    overlay.triangles.push_back({{2, 3, -3}, {2, -3, -3}, {2, 0, 3}, kRed});
    for (const bool one_sided : {false, true}) {
        overlay.one_sided_triangles = one_sided;
        draw(overlay);
        EXPECT_NEAR(cover(100, 75), 1.0, 0.02) << one_sided;
    }
    std::swap(overlay.triangles[0].a, overlay.triangles[0].b);
    for (const bool one_sided : {false, true}) {
        overlay.one_sided_triangles = one_sided;
        draw(overlay);
        EXPECT_NEAR(cover(100, 75), one_sided ? 0.0 : 1.0, 0.02) << one_sided;
    }
}

TEST_F(OverlayRendererGl, AWallHidesBoxes) {
    Overlay overlay;
    OverlayBox box;
    box.center = {6, 0, 0};
    box.half_size = {0.5, 1, 1};
    box.rgba = kRed;
    overlay.boxes.push_back(box);
    draw(overlay, 0.3F);
    EXPECT_NEAR(cover(105, 70), 0.3, 0.02);
}

TEST_F(OverlayRendererGl, FacesBetweenNeighboursAreLeftAway) {
    Overlay overlay;
    for (int i = 0; i < 2; ++i) {
        OverlayBox box;
        box.center = {2.0 + 0.5 * i, 0, 0};
        box.half_size = {0.25, 0.25, 0.25};
        box.rgba = kRed;
        overlay.boxes.push_back(box);
    }
    draw(overlay);
    // From inside the nearer one, the far face of the second would be the only one in sight.
    view_.pose.position = {2.0, 0, 0};
    const std::vector<std::uint8_t> before = drawn_;
    draw(overlay);
    EXPECT_EQ(cover(100, 75), 0.0);
    EXPECT_NE(before, drawn_);
}

// The software painter shares no code with OpenGL: if both draw the same, both are right.
TEST_F(OverlayRendererGl, AgreesWithThePainterOnThinLines) {
    Overlay overlay;
    for (int i = 0; i < 12; ++i) {
        overlay.lines.push_back(
            {{1.0 + 0.4 * i, -1.5, 0.1 * i - 0.5}, {6.0 - 0.3 * i, 1.5, 0.5}, kRed, 1.5});
    }
    for (const bool parallel : {false, true}) {
        view_.orthographic.reset();
        if (parallel) view_.orthographic = Orthographic{45.0, 100.0};
        draw(overlay, 0.22F);
        std::vector<std::uint8_t> painted = plain_;
        std::vector<float> depth;
        renderer_->target().readDepth(depth);
        paintOverlay(overlay, view_, depth, 1.0, painted);
        int apart = 0;
        double sum = 0.0;
        for (std::size_t i = 0; i < painted.size(); ++i) {
            const int difference = std::abs(int(painted[i]) - int(drawn_[i]));
            apart += difference > 40;
            sum += difference;
        }
        EXPECT_LT(apart, 60);
        EXPECT_LT(sum / static_cast<double>(painted.size()), 1.0);
    }
}

TEST_F(OverlayRendererGl, RefusesACanvasOfAnotherSize) {
    auto other = OverlayCanvas::create(kWidth, kHeight + 1);
    ASSERT_TRUE(other);
    EXPECT_FALSE(overlays_->draw({}, view_, renderer_->target(), *other));
}

TEST_F(OverlayRendererGl, TheTargetTellsWhatLiesUnderThePointer) {
    draw({});
    const RenderTarget::Pixel pixel = renderer_->target().readPixel(20, 30);
    EXPECT_NEAR(pixel.depth_m, 4.0F, 1e-4F);
    EXPECT_EQ(pixel.object_id, 1);
    EXPECT_EQ(renderer_->target().readPixel(-1, 30).object_id, 0);
}

}  // namespace
}  // namespace dollytrack::render::overlay_renderer_gl_test
