// How planning grows with the number of objects: buildings of rooms with 25 objects each. The last
// line gives the growth of real time (BigO), and the counters the stages that take most of it.
#include "engine/core/log.h"
#include "planning/pipeline/pipeline.h"
#include "tests/support/furnished_building.h"

#include <benchmark/benchmark.h>

#include <atomic>

namespace dollytrack {
namespace {

void planBuilding(benchmark::State& state) {
    log::setLevel(log::Level::Error);
    const auto objects = static_cast<int>(state.range(0));
    const auto scene = std::make_shared<const Scene>(test::furnishedBuilding(objects));
    std::shared_ptr<const Plan> plan;
    for (auto _ : state) {
        planning::Pipeline pipeline(scene);
        // The metrics render every frame, thousands without a budget, and are not part of
        // `plan_ms`.
        const auto enough = std::make_shared<std::atomic<bool>>(false);
        plan = nullptr;
        (void)pipeline.run(planning::PlanParams{}, {}, JobContext(enough, nullptr),
                           [&](const std::shared_ptr<const Plan>& made) {
                               plan = made;
                               *enough = true;
                           });
        if (!plan) return state.SkipWithError("planning failed");
        state.SetIterationTime(1e-3 * plan->plan_ms);
    }
    state.counters["map_ms"] = plan->map_ms;
    for (const StageTime& stage : plan->stages) {
        if (stage.milliseconds > 0.02 * plan->plan_ms) {
            state.counters[stage.name + "_ms"] = stage.milliseconds;
        }
    }
    state.counters["key_frames"] = static_cast<double>(plan->key_frames.size());
    state.SetComplexityN(objects);
}
// `plan_ms`, from targets to the timed trajectory, as it is published.
BENCHMARK(planBuilding)
    ->Arg(50)
    ->Arg(100)
    ->Arg(200)
    ->Arg(500)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Complexity();

}  // namespace
}  // namespace dollytrack
