// Time to map the free space. "Map" covers what the metric map_ms counts: the ray structure, the
// octree and the clearances.

#include "planning/free_space/free_space.h"

#include "engine/core/random.h"
#include "tests/support/scene_builder.h"

#include <benchmark/benchmark.h>

namespace dollytrack::planning {
namespace {

/// A room of 10 x 10 x 10 m with 60 pieces of furniture: cupboards, tables and lamps, turned
/// freely.
Scene hallWithFurniture() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {10, 10, 10});
    Random random(60);
    for (int i = 0; i < 60; ++i) {
        const double x = 0.9 + 1.17 * (i % 8) + random.uniform(-0.1, 0.1);
        const double y = 0.9 + 1.17 * (i / 8) + random.uniform(-0.1, 0.1);
        const double yaw = random.uniform(0.0, 3.1);
        builder.object("piece " + std::to_string(i));
        if (i % 3 == 0) {
            builder.box({x, y, 1.0}, {0.9, 0.5, 2.0}, yaw);
        } else if (i % 3 == 1) {
            builder.box({x, y, 0.72}, {0.9, 0.7, 0.04}, yaw);
            builder.box({x, y, 0.35}, {0.1, 0.1, 0.7}, yaw);
        } else {
            builder.box({x, y, 9.0}, {0.02, 0.02, 2.0}, yaw);
            builder.box({x, y, 7.8}, {0.4, 0.4, 0.4}, yaw);
        }
    }
    return builder.build();
}

void mapHall(benchmark::State& state) {
    const Scene scene = hallWithFurniture();
    const FreeSpaceParams params{static_cast<double>(state.range(0)) / 100.0};
    for (auto _ : state) {
        const RayCaster rays(scene);
        benchmark::DoNotOptimize(FreeSpace::build(scene, rays, CameraParams{}, params));
    }
}
BENCHMARK(mapHall)->ArgName("cm")->Arg(20)->Arg(5)->Unit(benchmark::kMillisecond)->UseRealTime();

void mapFurnishedRoom(benchmark::State& state) {
    const Scene scene = test::furnishedRoom();
    for (auto _ : state) {
        const RayCaster rays(scene);
        benchmark::DoNotOptimize(FreeSpace::build(scene, rays, CameraParams{}, FreeSpaceParams{}));
    }
}
BENCHMARK(mapFurnishedRoom)->Unit(benchmark::kMillisecond)->UseRealTime();

void lookUpClearance(benchmark::State& state) {
    const Scene scene = test::furnishedRoom();
    const Result<FreeSpace> space =
        FreeSpace::build(scene, RayCaster(scene), CameraParams{}, FreeSpaceParams{});
    Random random(1);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 4096; ++i) {
        points.emplace_back(random.uniform(0, 4), random.uniform(0, 3), random.uniform(0, 2.6));
    }
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(space->clearanceLowerBound(points[++i % points.size()]));
    }
}
BENCHMARK(lookUpClearance);

}  // namespace
}  // namespace dollytrack::planning
