#include "ui/viewport/render_thread.h"

#include "tests/render/gl_fixture.h"
#include "tests/support/scene_builder.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace dollytrack::ui::render_thread_gl_test {
namespace {

constexpr int kSize = 64;

render::LightVolume uniformLight() {
    render::LightVolume light;
    light.cells = {1, 1, 1};
    light.ambient.assign(1, Eigen::Vector3f::Ones());
    light.lamps.assign(1, Eigen::Vector3f::Zero());
    return light;
}

/// A wall across the whole image, white without its texture of one colour.
Scene texturedWall(std::vector<std::uint8_t> rgba = {10, 250, 10, 255}) {
    test::SceneBuilder builder;
    builder.object("wall").quad({4, -20, -20}, {0, 40, 0}, {0, 0, 40});
    Scene scene = builder.build();
    scene.textures.push_back({"paint", 1, 1, std::move(rgba)});
    for (Material& material : scene.materials) {
        material.base_color = Eigen::Vector3f::Ones();
        material.texture = 0;
    }
    return scene;
}

class RenderThreadGl : public render::fixture::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!context_) return;
        // The window's context, current on this thread; the other one draws.
        Result<std::unique_ptr<gl::Context>> window = gl::createOsMesaContext();
        ASSERT_TRUE(window) << describe(window.error());
        window_ = std::move(*window);
        drawing_.emplace(std::move(context_), [this] {
            const std::lock_guard lock(mutex_);
            woken_.notify_one();
        });
    }

    void setScene(const Scene& scene, std::uint64_t geometry,
                  std::shared_ptr<const render::LightVolume> light = nullptr) {
        drawing_->setScene(
            {std::make_shared<const Scene>(scene), nullptr, std::move(light), 0, geometry});
    }

    void requestView(const Eigen::Vector3d& eye = Eigen::Vector3d::Zero(),
                     std::vector<MovedObject> moved = {}) {
        CameraParams camera;
        camera.width_px = kSize;
        camera.height_px = kSize;
        drawing_->requestView(
            {render::makeView(camera, lookAt(eye, eye + Eigen::Vector3d::UnitX())),
             {},
             1.0,
             std::move(moved)});
    }

    /// Waits until nothing remains to be drawn, and returns the colour of the newest image.
    std::array<int, 3> settledColor() {
        std::unique_lock lock(mutex_);
        while (drawing_->busy()) woken_.wait_for(lock, std::chrono::milliseconds(20));
        lock.unlock();
        drawing_->takeNews();
        const std::vector<std::uint8_t>& rgba = drawing_->view().rgba;
        if (rgba.empty()) return {};
        const std::uint8_t* middle = &rgba[4 * (kSize * kSize / 2 + kSize / 2)];
        return {middle[0], middle[1], middle[2]};
    }

    std::unique_ptr<gl::Context> window_;
    std::mutex mutex_;
    std::condition_variable woken_;
    std::optional<RenderThread> drawing_;
};

bool isGreen(const std::array<int, 3>& color) {
    return color[1] > color[0] + 60 && color[1] > color[2] + 60;
}

TEST_F(RenderThreadGl, TexturesFollowTheFirstImage) {
    setScene(texturedWall(), 1);
    requestView();
    EXPECT_TRUE(isGreen(settledColor()));
    EXPECT_EQ(drawing_->view().serial, 2U);
    EXPECT_EQ(drawing_->takeError(), "");
}

TEST_F(RenderThreadGl, ProbesAreClassifiedInTheLightOfTheScene) {
    CameraParams camera;
    camera.width_px = 80;
    camera.height_px = 60;
    const RenderThread::Views views(
        3, render::makeView(camera, lookAt(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX())));
    const auto probes = std::make_shared<const RenderThread::Views>(views);
    const auto classesOf = [&](float brightness) {
        render::LightVolume light = uniformLight();
        light.ambient.assign(1, Eigen::Vector3f::Constant(brightness));
        setScene(texturedWall({128, 128, 128, 255}), brightness > 0.5F ? 1 : 2,
                 std::make_shared<const render::LightVolume>(light));
        requestView();
        drawing_->requestProbes(probes);
        std::unique_lock lock(mutex_);
        while (drawing_->probing() && drawing_->probesDone() < probes->size()) {
            woken_.wait_for(lock, std::chrono::milliseconds(20));
        }
        return drawing_->probes();
    };
    using render::PictureQuality;
    EXPECT_EQ(classesOf(0.0F), std::vector<PictureQuality>(3, PictureQuality::Dark));
    EXPECT_EQ(classesOf(1.0F), std::vector<PictureQuality>(3, PictureQuality::Flat));
    drawing_->requestProbes(nullptr);
    EXPECT_TRUE(drawing_->probes().empty());
    EXPECT_EQ(drawing_->takeError(), "");
}

TEST_F(RenderThreadGl, ProbesOfAnImpossibleSizeEndWithAnError) {
    CameraParams camera;
    camera.width_px = camera.height_px = 1'000'000;
    const auto probes = std::make_shared<const RenderThread::Views>(
        1, render::makeView(camera, lookAt(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX())));
    setScene(texturedWall(), 1, std::make_shared<const render::LightVolume>(uniformLight()));
    requestView();
    settledColor();
    drawing_->requestProbes(probes);
    std::unique_lock lock(mutex_);
    while (drawing_->probing()) woken_.wait_for(lock, std::chrono::milliseconds(20));
    EXPECT_TRUE(drawing_->probes().empty());
    EXPECT_NE(drawing_->takeError(), "");
}

TEST_F(RenderThreadGl, ProbesShowNoObjectWhereADragHasIt) {
    CameraParams camera;
    camera.width_px = 80;
    camera.height_px = 60;
    const auto probes = std::make_shared<const RenderThread::Views>(
        3, render::makeView(camera, lookAt(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX())));
    setScene(texturedWall({128, 128, 128, 255}), 1,
             std::make_shared<const render::LightVolume>(uniformLight()));
    requestView();
    settledColor();
    MovedObject aside{1, Eigen::Isometry3d::Identity()};  // the probes would be black
    for (const double way_m : {10.0, 20.0, 30.0}) {
        aside.motion = Eigen::Translation3d(-way_m, 0, 0);
        requestView({0, 0, 0}, {aside});
        drawing_->requestProbes(probes);
        settledColor();
        EXPECT_TRUE(drawing_->probes().empty());
    }
    requestView();
    std::unique_lock lock(mutex_);
    while (drawing_->probing() && drawing_->probesDone() < probes->size()) {
        woken_.wait_for(lock, std::chrono::milliseconds(20));
    }
    EXPECT_EQ(drawing_->probes(),
              std::vector<render::PictureQuality>(3, render::PictureQuality::Flat));
    EXPECT_EQ(drawing_->takeError(), "");
}

TEST_F(RenderThreadGl, ASceneWhoseTexturesCannotBeUploadedStaysPlainAndMovable) {
    Scene scene = texturedWall();
    scene.textures[0].height = 0;  // OpenGL refuses it, as it refuses one too large for its memory
    setScene(scene, 1, std::make_shared<const render::LightVolume>(uniformLight()));
    requestView();
    const auto first = settledColor();
    EXPECT_FALSE(isGreen(first));
    EXPECT_NE(drawing_->takeError().find("without textures"), std::string::npos);
    drawing_->requestProbes(std::make_shared<const RenderThread::Views>(1));
    EXPECT_FALSE(drawing_->probing()) << "images would lack the textures";
    drawing_->requestProbes(nullptr);
    EXPECT_TRUE(drawing_->finalLight());
    const std::uint64_t serial = drawing_->view().serial;
    requestView({1, 0, 0});
    settledColor();
    EXPECT_GT(drawing_->view().serial, serial);
    EXPECT_NEAR(drawing_->view().depth_m[kSize * kSize / 2], 3.0F, 1e-4F);
    EXPECT_EQ(drawing_->takeError(), "") << "it is said once";

    setScene(scene, 2);
    requestView();
    settledColor();
    EXPECT_EQ(drawing_->view().geometry, 2U) << "an edit of the scene";
    EXPECT_EQ(drawing_->takeError(), "");

    drawing_->setScene({});
    settledColor();
    setScene(texturedWall(), 3);
    requestView();
    EXPECT_TRUE(isGreen(settledColor())) << "another project has its textures";
}

TEST_F(RenderThreadGl, AMovedObjectIsDrawnElsewhereUntilItIsNotMoved) {
    setScene(texturedWall(), 1);
    const auto depth = [&] {
        settledColor();
        return drawing_->view().depth_m[kSize * kSize / 2 + kSize / 2];
    };
    requestView();
    EXPECT_NEAR(depth(), 4.0F, 1e-4F);
    MovedObject nearer{1, Eigen::Isometry3d::Identity()};
    nearer.motion.translate(Eigen::Vector3d(-1.5, 0, 0));
    requestView({0, 0, 0}, {nearer});
    EXPECT_NEAR(depth(), 2.5F, 1e-4F);
    nearer.motion.translate(Eigen::Vector3d(0.5, 0, 0));
    requestView({0, 0, 0}, {nearer});
    EXPECT_NEAR(depth(), 3.0F, 1e-4F);
    requestView();
    EXPECT_NEAR(depth(), 4.0F, 1e-4F);
    requestView({0, 0, 0}, {nearer});
    setScene(texturedWall(), 2);
    requestView();
    EXPECT_NEAR(depth(), 4.0F, 1e-4F) << "an edited scene begins where it has its objects";
    EXPECT_EQ(drawing_->takeError(), "");
}

TEST_F(RenderThreadGl, AnEditedSceneLosesItsTexturesIfTheyCannotBeUploaded) {
    Scene scene = texturedWall();
    setScene(scene, 1);
    requestView();
    EXPECT_TRUE(isGreen(settledColor()));
    scene.textures[0].height = 0;
    setScene(scene, 2);
    requestView();
    EXPECT_FALSE(isGreen(settledColor()));
    EXPECT_EQ(drawing_->view().geometry, 2U);
    EXPECT_NE(drawing_->takeError().find("without textures"), std::string::npos);
}

TEST_F(RenderThreadGl, NewLightOrGeometryWhileTheSceneIsPlainLeadsToTheNewestScene) {
    setScene(texturedWall(), 1);
    requestView();
    setScene(texturedWall(), 1, std::make_shared<const render::LightVolume>(uniformLight()));
    requestView();
    EXPECT_TRUE(isGreen(settledColor()));
    EXPECT_TRUE(drawing_->finalLight());

    setScene(texturedWall(), 2);
    requestView();
    setScene(texturedWall({250, 10, 10, 255}), 3);
    requestView();
    const auto color = settledColor();
    EXPECT_GT(color[0], color[1] + 60);
    EXPECT_EQ(drawing_->view().geometry, 3U);
    EXPECT_FALSE(drawing_->finalLight());
    EXPECT_EQ(drawing_->takeError(), "");
}

}  // namespace
}  // namespace dollytrack::ui::render_thread_gl_test
