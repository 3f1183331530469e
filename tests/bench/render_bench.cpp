// Frames per second of the whole export: rendering, counting pixels, compressing and writing. The
// room is generated, or DOLLYTRACK_BENCH_SCENE names a scene file.

#include "engine/camera/intrinsics.h"
#include "engine/core/random.h"
#include "engine/io/import/scene_import.h"
#include "render/dataset/dataset_job.h"
#include "render/gl/osmesa_context.h"
#include "render/light/light_volume.h"
#include "render/overlays/overlay_renderer.h"
#include "tests/support/scene_builder.h"

#include <GL/glew.h>
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

namespace {

using namespace dollytrack;

/// A room of 5 x 5 m with 60 balls of about `rings` * 2 * rings triangles each.
Scene ballRoom(int rings) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {5, 5, 2.8});
    Random random(3);
    for (int ball = 0; ball < 60; ++ball) {
        builder.object("ball " + std::to_string(ball));
        const Eigen::Vector3d center(random.uniform(0.3, 4.7), random.uniform(0.3, 4.7),
                                     random.uniform(0.2, 1.2));
        const auto at = [&](int i, int j) {
            const double polar = std::numbers::pi * i / rings;
            const double around = 2.0 * std::numbers::pi * j / rings;
            return Eigen::Vector3d(center +
                                   0.2 * Eigen::Vector3d(std::sin(polar) * std::cos(around),
                                                         std::sin(polar) * std::sin(around),
                                                         std::cos(polar)));
        };
        for (int i = 0; i < rings; ++i) {
            for (int j = 0; j < rings; ++j) {
                builder.quad(at(i, j), at(i + 1, j) - at(i, j), at(i, j + 1) - at(i, j));
            }
        }
    }
    return builder.build();
}

Result<Scene> benchScene() {
    const char* path = std::getenv("DOLLYTRACK_BENCH_SCENE");
    return path != nullptr ? importScene(path) : Result<Scene>(ballRoom(58));
}

Trajectory circle(const Scene& scene, int frames) {
    Trajectory trajectory;
    Eigen::Vector3d center = scene.room_bounds.center();
    center.z() = scene.room_bounds.min().z() + 1.45;
    for (int i = 0; i < frames; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / frames;
        const Eigen::Vector3d way(std::cos(angle), std::sin(angle), 0.0);
        TrajectoryFrame frame;
        frame.time_s = 0.1 * i;
        frame.target_in_world = center + 2.0 * way - Eigen::Vector3d(0, 0, 0.5);
        frame.pose = lookAt(center - 0.5 * way, frame.target_in_world);
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

void exportFrames(benchmark::State& state) {
    const Result<Scene> scene = benchScene();
    if (!scene) return state.SkipWithError(describe(scene.error()).c_str());
    const RayCaster rays(*scene);
    const Trajectory trajectory = circle(*scene, 48);
    std::string folder = (std::filesystem::temp_directory_path() / "dollytrack_XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) return state.SkipWithError("no temporary folder");
    for (auto _ : state) {
        state.PauseTiming();
        auto context = gl::createOsMesaContext();
        if (!context) return state.SkipWithError(describe(context.error()).c_str());
        render::DatasetSettings settings;
        settings.folder = folder;
        settings.picture.antialias = static_cast<Antialias>(state.range(0));
        auto job = render::DatasetJob::begin(std::move(*context), *scene, rays, trajectory, {},
                                             settings, {});
        if (!job) return state.SkipWithError(describe(job.error()).c_str());
        state.ResumeTiming();
        while (true) {
            const auto more = job->step();
            if (!more) return state.SkipWithError(describe(more.error()).c_str());
            if (!*more) break;
        }
        if (const auto done = job->finish(); !done) {
            return state.SkipWithError(describe(done.error()).c_str());
        }
    }
    std::filesystem::remove_all(folder);
    state.counters["triangles"] = static_cast<double>(scene->triangles.size());
    state.counters["frames_per_s"] =
        benchmark::Counter(static_cast<double>(state.iterations() * trajectory.frames.size()),
                           benchmark::Counter::kIsRate);
}
BENCHMARK(exportFrames)->Unit(benchmark::kMillisecond)->UseRealTime()->DenseRange(0, 2);

void bakeLight(benchmark::State& state) {
    const Result<Scene> scene = benchScene();
    if (!scene) return state.SkipWithError(describe(scene.error()).c_str());
    const RayCaster rays(*scene);
    const render::LightRig rig = render::makeLightRig(*scene, rays);
    for (auto _ : state) benchmark::DoNotOptimize(render::bakeLightVolume(*scene, rays, rig));
}
BENCHMARK(bakeLight)->Unit(benchmark::kMillisecond)->UseRealTime();

/// 20,000 cells of a slice, 5,000 lines and 1,000 markers over an image of 900 x 560.
void drawOverlays(benchmark::State& state) {
    auto context = gl::createOsMesaContext();
    if (!context) return state.SkipWithError(describe(context.error()).c_str());
    render::Overlay overlay;
    for (int i = 0; i < state.range(0); ++i) {
        render::OverlayBox box;
        box.center = {0.05 * (i % 200) - 5.0, 0.05 * (i / 200 % 100) - 2.5, -0.05 * (i / 20000)};
        box.half_size.setConstant(0.025);
        box.rgba = {i % 3 == 0 ? 1.0F : 0.2F, 0.4F, 0.8F, 0.5F};
        overlay.boxes.push_back(box);
    }
    Random random(5);
    const auto place = [&] {
        return Eigen::Vector3d(random.uniform(-5, 5), random.uniform(-2.5, 2.5),
                               random.uniform(0, 2));
    };
    for (int i = 0; i < state.range(1); ++i) {
        const Eigen::Vector3d a = place();
        overlay.lines.push_back({a, a + 0.05 * place(), {1, 0.5F, 0, 1}, 3.0});
        if (i % 5 == 0) overlay.marks.push_back({place()});
    }
    CameraParams camera;
    camera.width_px = 900;
    camera.height_px = 560;
    render::View view;
    view.intrinsics = makeIntrinsics(camera);
    view.pose = lookAt({2, -7, 7}, {0, 0, 0});
    auto target = render::RenderTarget::create(camera.width_px, camera.height_px);
    auto canvas = render::OverlayCanvas::create(camera.width_px, camera.height_px);
    auto renderer = render::OverlayRenderer::create();
    if (!target || !canvas || !renderer) return state.SkipWithError("no overlay renderer");
    render::OverlayBuffers buffers;
    buffers.upload(overlay);
    const render::OverlayLayer layer{&buffers};
    for (auto _ : state) {
        if (!renderer->draw({&layer, 1}, view, *target, *canvas)) return;
        glFinish();
    }
}
BENCHMARK(drawOverlays)
    ->Args({0, 0})
    ->Args({0, 5000})
    ->Args({1, 0})
    ->Args({20000, 0})
    ->Args({20000, 5000})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
