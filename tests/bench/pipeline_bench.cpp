// Planning as a user waits for it. DOLLYTRACK_BENCH_SCENE names a scene; else the apartment.
#include "engine/core/log.h"
#include "engine/io/scene_import.h"
#include "planning/pipeline.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdlib>

namespace dollytrack {
namespace {

std::shared_ptr<const Scene> benchScene() {
    static const auto scene = [] {
        log::setLevel(log::Level::Error);
        const char* path = std::getenv("DOLLYTRACK_BENCH_SCENE");
        Result<Scene> loaded = importScene(path ? path : DOLLYTRACK_APARTMENT);
        return loaded ? std::make_shared<const Scene>(std::move(*loaded)) : nullptr;
    }();
    return scene;
}

planning::PlanParams params() {
    planning::PlanParams p;
    p.timing.max_frames = 300;
    return p;
}

/// From nothing: `plan_ms` and `map_ms` are the published figures.
void planFromScratch(benchmark::State& state) {
    const auto scene = benchScene();
    if (!scene) return state.SkipWithError("the scene cannot be loaded");
    for (auto _ : state) {
        planning::Pipeline pipeline(scene);
        const auto plan = pipeline.run(params(), JobContext{});
        if (!plan) return state.SkipWithError("planning failed");
        state.counters["plan_ms"] = (*plan)->plan_ms;
        state.counters["map_ms"] = (*plan)->map_ms;
        state.counters["well_captured_rate"] = (*plan)->capture_metrics.well_captured_rate;
    }
}
BENCHMARK(planFromScratch)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Milliseconds from a change to the new trajectory, as the editor waits for it: `change` alters
/// the parameters by a step that alternates.
template <class Change>
void replanAfter(benchmark::State& state, Change&& change) {
    const auto scene = benchScene();
    if (!scene) return state.SkipWithError("the scene cannot be loaded");
    planning::Pipeline pipeline(scene);
    planning::PlanParams p;
    if (!pipeline.run(p, JobContext{})) return state.SkipWithError("planning failed");
    bool odd = true;
    for (auto _ : state) {
        change(p, odd);
        odd = !odd;
        const auto begin = std::chrono::steady_clock::now();
        std::chrono::duration<double> until_trajectory{};
        const auto plan = pipeline.run(p, {}, JobContext{}, [&](const auto&) {
            until_trajectory = std::chrono::steady_clock::now() - begin;
        });
        if (!plan) return state.SkipWithError("planning failed");
        state.SetIterationTime(until_trajectory.count());
    }
}

void replanFromRadius(benchmark::State& state) {
    replanAfter(state, [](planning::PlanParams& p, bool odd) {
        p.camera.camera_radius_m = odd ? 0.12 : 0.15;
    });
}
BENCHMARK(replanFromRadius)->Unit(benchmark::kMillisecond)->UseManualTime();

void replanFromResolution(benchmark::State& state) {
    replanAfter(state, [](planning::PlanParams& p, bool odd) {
        p.free_space.octree_resolution_m = odd ? 0.045 : 0.05;
    });
}
BENCHMARK(replanFromResolution)->Unit(benchmark::kMillisecond)->UseManualTime();

void replanFromFieldOfView(benchmark::State& state) {
    replanAfter(state,
                [](planning::PlanParams& p, bool odd) { p.camera.hfov_deg = odd ? 62.0 : 60.0; });
}
BENCHMARK(replanFromFieldOfView)->Unit(benchmark::kMillisecond)->UseManualTime();

/// What dragging a slider of the smoothing costs.
void replanFromSmoothing(benchmark::State& state) {
    const auto scene = benchScene();
    if (!scene) return state.SkipWithError("the scene cannot be loaded");
    planning::Pipeline pipeline(scene);
    planning::PlanParams p = params();
    double distance = 0.30;
    for (auto _ : state) {
        p.smoothing.corner_distance_m = distance;
        distance = distance > 0.5 ? 0.30 : distance + 0.01;
        benchmark::DoNotOptimize(pipeline.run(p, JobContext{}));
    }
}
BENCHMARK(replanFromSmoothing)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace dollytrack
