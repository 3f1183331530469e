#include "planning/pipeline/search_environment.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/allowed_region.h"
#include "planning/free_space/free_space.h"
#include "planning/pipeline/pipeline.h"

#include <utility>

namespace dollytrack::planning {

SceneMaps mapsOf(const Pipeline& pipeline, std::shared_ptr<const Scene> scene) {
    return {std::move(scene), pipeline.rays(), pipeline.freeSpace(), pipeline.region()};
}

SearchEnvironment::SearchEnvironment(SceneMaps maps, const PlanParams& params)
    : maps_(std::move(maps)),
      views_(*maps_.scene, *maps_.rays, params.camera),
      sphere_(*maps_.rays, *maps_.free_space, params.camera.camera_radius_m, maps_.region.get()),
      environment_{views_, *maps_.free_space, sphere_, pitchBand(params.constraints)} {}

}  // namespace dollytrack::planning
