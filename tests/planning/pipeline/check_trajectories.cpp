// Plans scenes with several settings and checks every trajectory against the exact triangles with
// the slow checker. Exit code 1 when a trajectory touches anything.

#include "engine/core/log.h"
#include "engine/io/import/scene_import.h"
#include "planning/pipeline/pipeline.h"
#include "tests/planning/support/slow_checker.h"

#include <cstdio>

namespace dollytrack::planning {
namespace {

/// Number of positions that touch something, over all plans of a scene; -1 when planning fails.
int checkScene(const char* path) {
    Result<Scene> loaded = importScene(path);
    if (!loaded) {
        std::printf("%s: %s\n", path, describe(loaded.error()).c_str());
        return -1;
    }
    const auto scene = std::make_shared<const Scene>(std::move(*loaded));
    const test_support::SlowChecker checker(*scene);
    Pipeline pipeline(scene);
    int touching = 0;
    for (const double corner : {0.1, 0.3, 1.0}) {
        PlanParams params;
        params.smoothing.corner_distance_m = corner;
        const auto plan = pipeline.run(params, JobContext{});
        if (!plan) {
            std::printf("%s: %s\n", path, describe(plan.error()).c_str());
            return -1;
        }
        const auto found = checker.check(**plan, params.camera.camera_radius_m, false);
        std::printf("%s: corner %.2f m: %d of %ld places touch, least %.4f m, reported %.4f m\n",
                    scene->name.c_str(), corner, found.touching, found.places, found.clearance_m,
                    (*plan)->trajectory_metrics.minimum_clearance.clearance_m);
        touching += found.touching;
    }
    return touching;
}

}  // namespace
}  // namespace dollytrack::planning

int main(int argc, char** argv) {
    dollytrack::log::setLevel(dollytrack::log::Level::Error);
    bool clean = argc > 1;
    for (int i = 1; i < argc; ++i) {
        clean = dollytrack::planning::checkScene(argv[i]) == 0 && clean;
    }
    return clean ? 0 : 1;
}
