#include "render/light/traced_reflections.h"

#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

namespace dollytrack::render::traced_reflections_gl_test {
namespace {

using dollytrack::test::SceneBuilder;

constexpr int kMirror = 1;
constexpr double kMirrorX = 2.0;

/// A room with a mirror at x = 2, objects in front of it and coloured walls; the camera's side is
/// at x = 0.
Scene mirrorRoom(float roughness = 0.05F, float metallic = 1.0F) {
    SceneBuilder builder;
    builder.object("mirror", {kNyuOtherProp, Role::Structure, {1, 1, 1}})
        .quad({kMirrorX, 1, -1}, {0, -2, 0}, {0, 0, 2});
    builder.object("red", {kNyuOtherProp, Role::Target, {0.8F, 0.1F, 0.1F}})
        .box({-0.8, 0.5, -0.2}, {0.4, 0.5, 0.9}, 0.4);
    builder.object("green", {kNyuOtherProp, Role::Target, {0.1F, 0.7F, 0.2F}})
        .box({-1.2, -0.6, 0.1}, {0.5, 0.4, 0.7}, 0.2);
    builder.room({-2.5, -1.6, -1.2}, {2.1, 1.6, 1.3});
    Scene scene = builder.build();
    Material& mirror = scene.materials[scene.triangle_material[0]];
    mirror.roughness = roughness;
    mirror.metallic = metallic;
    return scene;
}

CameraParams smallCamera() {
    CameraParams camera;
    camera.width_px = 128;
    camera.height_px = 96;
    return camera;
}

View mirrorView(Reflections reflections = Reflections::Mirrors) {
    View view = makeView(smallCamera(), lookAt({0, 0.2, 0.1}, {1, 0.2, 0.1}));
    view.reflections = reflections;
    return view;
}

class TracedReflectionsGl : public fixture::GlTest {
  protected:
    struct Drawn {
        std::vector<std::uint8_t> rgb;
        std::vector<std::uint16_t> ids;
    };

    void make(Scene scene) {
        scene_ = std::move(scene);
        rays_.emplace(scene_);
        LightVolumeParams params;
        params.max_cells = 3000;
        light_ = bakeLightVolume(scene_, *rays_, makeLightRig(scene_, *rays_), params);
        auto renderer = OffscreenRenderer::create(std::move(context_), scene_, light_, 128, 96);
        ASSERT_TRUE(renderer) << describe(renderer.error());
        renderer_.emplace(std::move(*renderer));
    }

    Drawn draw(const View& view, const TracedReflections* reflections) {
        renderer_->scene().setReflections(reflections);
        Drawn drawn;
        EXPECT_TRUE(renderer_->scene().draw(view, renderer_->target()));
        renderer_->target().readRgb(drawn.rgb);
        renderer_->target().readIds(drawn.ids);
        return drawn;
    }

    Scene scene_;
    std::optional<RayCaster> rays_;
    LightVolume light_;
    std::optional<OffscreenRenderer> renderer_;
};

/// Mean difference on the scale 0..255 where the first image shows the mirror.
double differenceInMirror(const std::vector<std::uint16_t>& ids, const std::vector<std::uint8_t>& a,
                          const std::vector<std::uint8_t>& b) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] != kMirror) continue;
        ++count;
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) sum += std::abs(int{a[c]} - int{b[c]});
    }
    EXPECT_GT(count, 2000U);
    return sum / (3.0 * static_cast<double>(std::max<std::size_t>(count, 1)));
}

std::vector<std::uint8_t> mirrored(const std::vector<std::uint8_t>& rgb, int width, int height) {
    std::vector<std::uint8_t> turned(rgb.size());
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) {
                turned[3 * (y * width + x) + c] = rgb[3 * (y * width + width - 1 - x) + c];
            }
        }
    }
    return turned;
}

// A plane mirror shows the view of a camera behind it, with left and right exchanged.
TEST_F(TracedReflectionsGl, AMirrorShowsWhatACameraBehindItSees) {
    make(mirrorRoom());
    const CameraParams camera = smallCamera();
    const View view = mirrorView();
    View behind = makeView(camera, lookAt({2 * kMirrorX, 0.2, 0.1}, {0, 0.2, 0.1}));
    behind.near_m = 1.95;  // the wall behind the mirror is not there
    behind.hidden = {false, true};
    const TracedReflections reflections(scene_, *rays_, light_);
    const std::vector<std::uint8_t> wanted = mirrored(draw(behind, nullptr).rgb, 128, 96);
    const Drawn traced = draw(view, &reflections);
    const Drawn blurred = draw(view, nullptr);
    // The camera behind has corners darkened by ambient occlusion, which traced rays do not have.
    EXPECT_LT(differenceInMirror(traced.ids, traced.rgb, wanted), 5.0);
    EXPECT_GT(differenceInMirror(traced.ids, blurred.rgb, wanted), 15.0);
    // Outside the mirror nothing differs, except right beside it, where antialiasing blends the
    // edge.
    const auto isMirror = [&](int x, int y) { return traced.ids[y * 128 + x] == kMirror; };
    for (int y = 3; y < 93; ++y) {
        for (int x = 3; x < 125; ++x) {
            bool near_mirror = false;
            for (int k = -3; k <= 3; ++k) {
                near_mirror = near_mirror || isMirror(x + k, y) || isMirror(x, y + k);
            }
            const std::size_t i = std::size_t{3} * (y * 128 + x);
            if (!near_mirror) {
                ASSERT_EQ(traced.rgb[i], blurred.rgb[i]) << x << " " << y;
            }
        }
    }
}

TEST_F(TracedReflectionsGl, SeveralLooksShowTheSameMirror) {
    make(mirrorRoom());
    View view = mirrorView();
    const TracedReflections reflections(scene_, *rays_, light_);
    const Drawn once = draw(view, &reflections);
    view.antialias = Antialias::Samples4;
    const Drawn four = draw(view, &reflections);
    EXPECT_LT(differenceInMirror(once.ids, once.rgb, four.rgb), 2.0);
    EXPECT_EQ(once.ids, four.ids);
}

TEST_F(TracedReflectionsGl, OnlyWhatIsAskedForReflects) {
    const Scene rough = mirrorRoom(0.5F);
    const Scene polished = mirrorRoom(0.05F, 0.0F);
    EXPECT_TRUE(TracedReflections::any(mirrorRoom(), Reflections::Mirrors));
    EXPECT_FALSE(TracedReflections::any(mirrorRoom(), Reflections::Blurred));
    EXPECT_FALSE(TracedReflections::any(rough, Reflections::All));
    EXPECT_FALSE(TracedReflections::any(polished, Reflections::Mirrors));
    EXPECT_TRUE(TracedReflections::any(polished, Reflections::All));
    make(polished);
    const TracedReflections reflections(scene_, *rays_, light_);
    std::vector<Eigen::Vector4f> image;
    EXPECT_TRUE(reflections.trace(mirrorView(Reflections::All), 0, 96, image));
    EXPECT_FALSE(reflections.trace(mirrorView(Reflections::Mirrors), 0, 96, image));
    EXPECT_FALSE(reflections.trace(mirrorView(Reflections::Blurred), 0, 96, image));
    View away = makeView(smallCamera(), lookAt({0, 0, 0}, {-1, 0, 0}));
    away.reflections = Reflections::All;
    EXPECT_FALSE(reflections.trace(away, 0, 96, image));
}

TEST_F(TracedReflectionsGl, RowsAreThoseOfTheWholePicture) {
    make(mirrorRoom());
    const View view = mirrorView();
    const TracedReflections reflections(scene_, *rays_, light_);
    std::vector<Eigen::Vector4f> whole;
    std::vector<Eigen::Vector4f> part;
    ASSERT_TRUE(reflections.trace(view, 0, 96, whole));
    ASSERT_TRUE(reflections.trace(view, 40, 60, part));
    for (int y = 0; y < 96; ++y) {
        for (std::size_t x = 0; x < 128; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * 128 + x;
            const bool inside = y >= 40 && y < 60;
            ASSERT_EQ(part[i], inside ? whole[i] : Eigen::Vector4f::Zero()) << x << " " << y;
        }
    }
}

}  // namespace
}  // namespace dollytrack::render::traced_reflections_gl_test
