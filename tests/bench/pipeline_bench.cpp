// Planning as a user waits for it. DOLLYTRACK_BENCH_SCENE names a scene; else the apartment.
#include "engine/core/log.h"
#include "engine/io/scene_import.h"
#include "planning/pipeline.h"

#include <benchmark/benchmark.h>

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
