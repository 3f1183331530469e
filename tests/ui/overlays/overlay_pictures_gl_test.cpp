// Draws every overlay over a real scene and checks that it is visible and causes no OpenGL error.
// DOLLYTRACK_PICTURES=folder keeps the images for a visual check; DOLLYTRACK_PICTURE_SCENE names
// another scene than the apartment.

#include "engine/io/files/durable_file.h"
#include "engine/io/files/png_writer.h"
#include "engine/io/import/scene_import.h"
#include "render/draw/overview.h"
#include "render/overlays/overlay_renderer.h"
#include "tests/render/gl_fixture.h"
#include "tests/ui/overlays/planned_room.h"
#include "ui/overlays/candidates_overlay.h"
#include "ui/overlays/free_space_overlay.h"
#include "ui/overlays/points_overlay.h"
#include "ui/overlays/roadmap_overlay.h"
#include "ui/overlays/steps_overlay.h"
#include "ui/overlays/surface_overlay.h"
#include "ui/overlays/trajectory_overlay.h"

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>

namespace dollytrack::ui::overlay_pictures_gl_test {
namespace {

constexpr int kWidth = 900;
constexpr int kHeight = 560;

/// Planned once for all tests.
Result<fixture::PlannedRoom> plannedScene() {
    static const Result<fixture::PlannedRoom> planned = [] {
        const char* other = std::getenv("DOLLYTRACK_PICTURE_SCENE");
        return importScene(other != nullptr ? other : DOLLYTRACK_APARTMENT)
            .map([](const Scene& scene) { return fixture::planRoom(scene); });
    }();
    return planned;
}

class OverlayPicturesGl : public render::fixture::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!context_) return;
        const auto planned = plannedScene();
        ASSERT_TRUE(planned) << describe(planned.error());
        room_ = *planned;
        render::LightVolume light;
        light.cells = {1, 1, 1};
        light.ambient.assign(1, Eigen::Vector3f::Constant(0.9F));
        light.lamps.assign(1, Eigen::Vector3f::Zero());
        if (folder() != nullptr) {
            light = render::bakeLightVolume(
                *room_.scene, *room_.rays,
                render::makeLightRig(*room_.scene, *room_.rays, room_.plan->rooms));
        }
        auto renderer = render::OffscreenRenderer::create(std::move(context_), *room_.scene, light,
                                                          kWidth, kHeight);
        ASSERT_TRUE(renderer) << describe(renderer.error());
        renderer_.emplace(std::move(*renderer));
        auto overlays = render::OverlayRenderer::create();
        ASSERT_TRUE(overlays) << describe(overlays.error());
        overlays_.emplace(std::move(*overlays));
        auto canvas = render::OverlayCanvas::create(kWidth, kHeight);
        ASSERT_TRUE(canvas);
        canvas_.emplace(std::move(*canvas));
        buffers_.emplace();
        render::OverviewSettings settings;
        settings.width_px = kWidth;
        settings.height_px = kHeight;
        settings.supersampling = 1;
        view_ = render::overviewOf(*room_.scene, settings, room_.plan->rooms);
    }
    void TearDown() override {
        buffers_.reset();
        canvas_.reset();
        overlays_.reset();
    }

    static const char* folder() { return std::getenv("DOLLYTRACK_PICTURES"); }

    /// Draws one layer, checks that it changes the image, and keeps the image if requested.
    void show(const std::string& name, const PlanLayer& layer) {
        ASSERT_TRUE(renderer_->scene().draw(view_, renderer_->target()));
        std::vector<std::uint8_t> before;
        renderer_->target().readRgb(before);
        buffers_->upload(layer.overlay);
        const std::array<render::OverlayLayer, 1> layers = {{{&*buffers_}}};
        std::vector<std::uint8_t> rgb;
        double least_ms = 1e9;
        for (int i = 0; i < (folder() != nullptr ? 20 : 1); ++i) {
            const auto begin = std::chrono::steady_clock::now();
            const Status status = overlays_->draw(layers, view_, renderer_->target(), *canvas_);
            ASSERT_TRUE(status) << describe(status.error());
            canvas_->readRgb(rgb);
            const std::chrono::duration<double, std::milli> spent =
                std::chrono::steady_clock::now() - begin;
            least_ms = std::min(least_ms, spent.count());
        }
        std::size_t changed = 0;
        for (std::size_t i = 0; i < rgb.size(); ++i) changed += rgb[i] != before[i];
        EXPECT_GT(changed, 1000U) << name;
        if (folder() == nullptr) return;
        std::printf("%-28s %6zu boxes %6zu lines %5zu marks %6.1f ms\n", name.c_str(),
                    layer.overlay.boxes.size(), layer.overlay.lines.size(),
                    layer.overlay.marks.size(), least_ms);
        for (const LegendEntry& entry : layer.legend.entries) {
            std::printf("    %-40s %d\n", entry.name.c_str(), entry.count);
        }
        const auto png = encodePng(kWidth, kHeight, PngFormat::Rgb8, rgb);
        ASSERT_TRUE(png);
        ASSERT_TRUE(writeWhole(std::filesystem::path(folder()) / (name + ".png"), *png));
    }

    fixture::PlannedRoom room_;
    render::View view_;
    std::optional<render::OffscreenRenderer> renderer_;
    std::optional<render::OverlayRenderer> overlays_;
    std::optional<render::OverlayCanvas> canvas_;
    std::optional<render::OverlayBuffers> buffers_;
};

PlanLayer together(PlanLayer a, const PlanLayer& b) {
    const auto append = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    append(a.overlay.boxes, b.overlay.boxes);
    append(a.overlay.triangles, b.overlay.triangles);
    append(a.overlay.lines, b.overlay.lines);
    append(a.overlay.marks, b.overlay.marks);
    append(a.legend.entries, b.legend.entries);
    return a;
}

TEST_F(OverlayPicturesGl, EveryOverlayShows) {
    const Scene& scene = *room_.scene;
    const Plan& plan = *room_.plan;
    show("points", pointsLayer(scene, plan, room_.params.camera, {}));
    show("roadmap", roadmapLayer(plan, {}));
    RoadmapOverlayOptions quiet;
    quiet.refused = quiet.samples = false;
    show("roadmap_without_refused", roadmapLayer(plan, quiet));
    using C = TrajectoryColor;
    for (const auto& [name, color] :
         {std::pair{"trajectory_time", C::Time}, std::pair{"trajectory_clearance", C::Clearance},
          std::pair{"trajectory_speed", C::Speed}, std::pair{"trajectory_turn", C::TurnRate},
          std::pair{"trajectory_score", C::Score},
          std::pair{"trajectory_captured", C::NewlyCaptured}}) {
        TrajectoryOverlayOptions options;
        options.color = color;
        show(name, trajectoryLayer(plan, options));
    }
    show("points_and_trajectory",
         together(trajectoryLayer(plan, {}), pointsLayer(scene, plan, room_.params.camera, {})));
    Plan seen = plan;
    SurfaceShare& surface = seen.surface.emplace();
    surface.patch_m = 0.4;
    for (const PositionPoint& point : plan.position_points) {
        Eigen::Vector3f at = point.pose.position.cast<float>();
        surface.measured.push_back({at, Eigen::Vector3f::UnitZ(), PatchState::Unseen});
    }
    show("surface", surfaceLayer(*seen.surface, {}));
    CandidatesOverlayOptions candidates;
    for (std::size_t o = 0; o < plan.searches.size(); ++o) {
        const std::size_t tried = plan.searches[o].candidates.size();
        const std::size_t best = std::max(0, candidates.observation_point);
        if (candidates.observation_point < 0 || tried > plan.searches[best].candidates.size()) {
            candidates.observation_point = static_cast<int>(o);
        }
    }
    show("candidates", candidatesLayer(plan, candidates));
    const std::size_t steps = plan.roadmap.steps.steps.size();
    show("steps_third", stepsLayer(plan, steps / 3));
    show("steps_end", stepsLayer(plan, steps));
}

TEST_F(OverlayPicturesGl, TheMapShows) {
    FreeSpaceOverlayOptions options;
    const double middle = room_.free_space->rooms().front().box.center().z();
    options.slice = Slice{2, middle, 0.05};
    show("slice_state", freeSpaceLayer(*room_.free_space, options));
    options.color = CellColor::Clearance;
    show("slice_clearance", freeSpaceLayer(*room_.free_space, options));
    options.color = CellColor::Component;
    show("slice_rooms", freeSpaceLayer(*room_.free_space, options));
    options = {};
    options.free = false;
    show("occupied", freeSpaceLayer(*room_.free_space, options));
    options.free = true;
    options.occupied = false;
    options.min_level = 3;
    show("free_large", freeSpaceLayer(*room_.free_space, options));
}

TEST_F(OverlayPicturesGl, AnAxisViewShowsTheSameInPlan) {
    view_.pose = lookAt(room_.scene->room_bounds.center() + Eigen::Vector3d(0, 0, 20),
                        room_.scene->room_bounds.center());
    view_.intrinsics.cx = 0.5 * kWidth;
    view_.intrinsics.cy = 0.5 * kHeight;
    view_.structure_cut.reset();
    const Eigen::Vector2d size = room_.scene->room_bounds.sizes().head<2>();
    view_.orthographic =
        render::Orthographic{0.94 * std::min(kWidth / size.x(), kHeight / size.y()), 100.0};
    show("plan_view", together(trajectoryLayer(*room_.plan, {}),
                               pointsLayer(*room_.scene, *room_.plan, room_.params.camera, {})));
}

}  // namespace
}  // namespace dollytrack::ui::overlay_pictures_gl_test
