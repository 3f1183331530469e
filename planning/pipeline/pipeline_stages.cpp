#include "planning/pipeline/pipeline_stages.h"

#include "engine/core/log.h"

#include <fmt/format.h>

namespace dollytrack::planning {
namespace {

void warnOfUnscanned(const FreeSpace& map) {
    constexpr double kNearlyAll = 0.9;
    if (map.scannedShare().value_or(1.0) >= kNearlyAll) return;
    log::warn("planning", fmt::format("only {:.0f} % of the rooms was scanned; the camera avoids "
                                      "the rest and may miss objects there",
                                      100.0 * *map.scannedShare()));
}

}  // namespace

std::vector<int> structureClasses(const Scene& scene) {
    std::vector<int> classes;
    for (const Object& object : scene.objects) {
        if (object.structure) classes.push_back(object.nyu40);
    }
    return classes;
}

Status Pipeline::Stages::map(const PlanParams& params, const PlanEdits& edits,
                             const JobContext& job) {
    return run("rays", rays, RayInputs{geometry_version}, job.stage(0.0, 0.1, "rays"),
               [&]() -> Result<RayCaster> { return cache.cast(*scene); })
        .and_then([&] {
            const JobContext part = job.stage(0.1, 0.2, "surfaces");
            const auto before = surfaces.share();
            return run("surfaces", surfaces,
                       SurfaceInputs{geometry_version, params.free_space.octree_resolution_m}, part,
                       [&] {
                           const std::vector<int> moved = cache.takeMovedSinceSurfaces();
                           return before ? SurfaceMap::afterMoves(*before, *scene, moved,
                                                                  params.free_space, part)
                                         : SurfaceMap::build(*scene, params.free_space, part);
                       });
        })
        .and_then([&] {
            const JobContext part = job.stage(0.2, 0.4, "free space");
            const auto before = free_space.share();
            return run("free_space", free_space,
                       FreeSpaceInputs{surfaces.version(), params.camera.camera_radius_m}, part,
                       [&] {
                           const std::vector<int> moved = cache.takeMovedSinceFreeSpace();
                           return before ? FreeSpace::afterMoves(*before, surfaces.share(), moved,
                                                                 *scene, *rays, params.camera, part)
                                         : FreeSpace::buildOver(surfaces.share(), *scene, *rays,
                                                                params.camera, part);
                       });
        })
        .and_then([&] {
            if (!free_space.reused()) warnOfUnscanned(*free_space);
            const FreeSpaceParams& limits = params.free_space;
            return run("region", region,
                       RegionInputs{free_space.version(), structureClasses(*scene), edits.no_go,
                                    limits.min_height_m, limits.max_height_m, params.body},
                       job.stage(0.4, 0.4, "region"), [&]() -> Result<AllowedRegion> {
                           return AllowedRegion(*scene, *rays, *free_space, edits.no_go, limits,
                                                params.body, params.camera.camera_radius_m);
                       });
        })
        .and_then([&] {
            return run("views", views, ViewInputs{scene_version, params.camera},
                       job.stage(0.4, 0.42, "views"), [&]() -> Result<ViewEstimator> {
                           return ViewEstimator(*scene, *rays, params.camera);
                       });
        });
}

}  // namespace dollytrack::planning
