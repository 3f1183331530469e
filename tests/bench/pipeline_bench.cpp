// The planning times that a user waits for. DOLLYTRACK_BENCH_SCENE names a scene; the default is
// the apartment.
#include "engine/core/log.h"
#include "engine/io/import/scene_import.h"
#include "engine/scene/move_object.h"
#include "planning/pipeline/pipeline.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <vector>

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

/// Plans from scratch: `plan_ms` and `map_ms` are the published figures.
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

/// Milliseconds from a change to the new trajectory, as in the editor: `change` alters the
/// parameters by a step whose sign alternates.
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

/// Time from moving an object by 0.2 m, back and forth, to the new trajectory. Counters give the
/// time of the map, of the search and in total, in ms. The argument chooses the object: the one
/// whose box volume is nearest to that many litres.
void moveThing(benchmark::State& state, bool keep) {
    const auto imported = benchScene();
    if (!imported) return state.SkipWithError("the scene cannot be loaded");
    const double litres = static_cast<double>(state.range(0));
    const auto strangeness = [&](const Object& object) {
        if (object.structure) return std::numeric_limits<double>::infinity();
        return std::abs(std::log(std::max(1000.0 * object.box.volume(), 1e-3) / litres));
    };
    const Object& thing = *std::ranges::min_element(imported->objects, {}, strangeness);
    if (thing.structure) return state.SkipWithError("there is nothing to move");
    state.SetLabel(thing.name);
    auto moved = std::make_shared<Scene>(*imported);
    moveObject(*moved, thing.id, {0.2, 0.0, 0.0}, 0.0);
    planning::Pipeline pipeline(imported);
    if (!pipeline.run(params(), JobContext{})) return state.SkipWithError("planning failed");
    bool there = false;
    std::map<std::string, double> spent;
    for (auto _ : state) {
        there = !there;
        const std::shared_ptr<const Scene> scene = there ? moved : imported;
        const auto begin = std::chrono::steady_clock::now();
        if (keep) {
            pipeline.setScene(scene, false);
        } else {
            pipeline = planning::Pipeline(scene);
        }
        std::chrono::duration<double> until_trajectory{};
        const auto plan = pipeline.run(params(), {}, JobContext{}, [&](const auto&) {
            until_trajectory = std::chrono::steady_clock::now() - begin;
        });
        if (!plan) return state.SkipWithError("planning failed");
        state.SetIterationTime(until_trajectory.count());
        for (const StageTime& stage : (*plan)->stages) spent[stage.name] += stage.milliseconds;
    }
    for (const auto& [stage, milliseconds] : spent) {
        state.counters[stage] =
            benchmark::Counter(milliseconds, benchmark::Counter::kAvgIterations);
    }
}

void replanFromMove(benchmark::State& state) {
    moveThing(state, true);
}
BENCHMARK(replanFromMove)
    ->ArgName("litres")
    ->Arg(1)
    ->Arg(100)
    ->Arg(1700)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();

void moveFromScratch(benchmark::State& state) {
    moveThing(state, false);
}
BENCHMARK(moveFromScratch)
    ->ArgName("litres")
    ->Arg(1)
    ->Arg(1700)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();

/// Time to plan anew while a smoothing slider is dragged.
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
