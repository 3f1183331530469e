#include "render/draw/scene_renderer.h"

#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::render::occlusion_culling_gl_test {
namespace {

using dollytrack::test::SceneBuilder;

constexpr int kWall = 1, kBehind = 2, kPeeking = 3, kPane = 4, kBehindPane = 5;

/// A sheet of 50,000 triangles across the view, from y to y + 1.
void addDense(SceneBuilder& builder, const std::string& name, double x, double y) {
    builder.object(name);
    for (int i = 0; i < 250; ++i) {
        for (int k = 0; k < 100; ++k) {
            builder.quad({x, y + i / 250.0, -0.5 + k / 100.0}, {0, 1 / 250.0, 0},
                         {0, 0, 1 / 100.0});
        }
    }
}

/// Seen from the origin along x: on the left a wall with one object fully and one partly behind it,
/// on the right an object behind a pane of glass.
Scene thingsBehindThings() {
    SceneBuilder builder;
    builder.object("wall").quad({2, 0.3, -3}, {0, 6, 0}, {0, 0, 6});
    addDense(builder, "behind", 3.0, 1.0);
    addDense(builder, "peeking", 4.0, 0.0);
    builder.object("pane").quad({2, -4, -3}, {0, 4, 0}, {0, 0, 6});
    addDense(builder, "behind pane", 3.0, -1.5);
    Scene scene = builder.build();
    Material glass;
    glass.opacity = 0.3F;
    scene.materials.push_back(glass);
    const Object& pane = scene.object(kPane);
    for (std::uint32_t i = 0; i < pane.triangle_count; ++i) {
        scene.triangle_material[pane.first_triangle + i] =
            static_cast<std::uint32_t>(scene.materials.size() - 1);
    }
    return scene;
}

class OcclusionCullingGl : public fixture::GlTest {
  protected:
    void SetUp() override {
        fixture::GlTest::SetUp();
        if (IsSkipped()) return;
        camera_.width_px = 160;
        camera_.height_px = 120;
        auto renderer = makeRenderer(scene_, camera_);
        ASSERT_TRUE(renderer) << describe(renderer.error());
        renderer_ = std::move(*renderer);
        auto target = RenderTarget::create(camera_.width_px, camera_.height_px);
        ASSERT_TRUE(target) << describe(target.error());
        target_.emplace(std::move(*target));
    }

    std::vector<std::uint8_t> draw(const Pose& pose, std::vector<bool> hidden = {}) {
        View view = makeView(camera_, pose);
        view.antialias = Antialias::Samples4;
        view.hidden = std::move(hidden);
        EXPECT_TRUE(renderer_->scene().draw(view, *target_));
        std::vector<std::uint8_t> rgb;
        target_->readRgb(rgb);
        return rgb;
    }

    /// A list for View::hidden with only this object.
    static std::vector<bool> only(int id) {
        std::vector<bool> hidden(static_cast<std::size_t>(id) + 1, false);
        hidden.back() = true;
        return hidden;
    }

    const Scene scene_ = thingsBehindThings();
    CameraParams camera_;
    std::optional<OffscreenRenderer> renderer_;
    std::optional<RenderTarget> target_;
};

TEST_F(OcclusionCullingGl, LeavesOutWhatStandsWhollyBehindOthers) {
    const Pose ahead = lookAt({0, 0, 0}, {1, 0, 0});
    const std::vector<std::uint8_t> picture = draw(ahead);
    EXPECT_EQ(renderer_->scene().hiddenByOthers(), 1);
    EXPECT_EQ(picture, draw(ahead, only(kBehind))) << "it was not that which nothing shows";
    // Objects that are visible past an edge or through glass are drawn.
    EXPECT_NE(picture, draw(ahead, only(kPeeking)));
    EXPECT_NE(picture, draw(ahead, only(kBehindPane)));
    EXPECT_NE(picture, draw(ahead, only(kWall)));
}

TEST_F(OcclusionCullingGl, AsksAnewFromEveryPlace) {
    (void)draw(lookAt({0, 0, 0}, {1, 0, 0}));
    const std::vector<std::uint8_t> beside = draw(lookAt({2.1, 0.9, 0}, {4, 1.2, 0}));
    EXPECT_EQ(renderer_->scene().hiddenByOthers(), 0) << "from behind the wall it is in sight";
    EXPECT_NE(beside, draw(lookAt({2.1, 0.9, 0}, {4, 1.2, 0}), only(kBehind)));
}

// The wall is cut away: objects behind it are visible, although the wall is still inside the view.
TEST_F(OcclusionCullingGl, SeesBehindAWallThatIsLeftAway) {
    (void)draw(lookAt({0, 0, 0}, {1, 0, 0}), only(kWall));
    EXPECT_EQ(renderer_->scene().hiddenByOthers(), 0);
}

}  // namespace
}  // namespace dollytrack::render::occlusion_culling_gl_test
