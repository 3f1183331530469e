#pragma once

#include "engine/geometry/ray_caster.h"
#include "planning/plan_params.h"
#include "render/object_motion.h"

#include <vector>

namespace dollytrack::cli {

/// What stands on, lies in or hangs on what, floors and walls among it, for the dataset.
[[nodiscard]] std::vector<render::ObjectRelation> relationsOf(const Scene& scene,
                                                              const RayCaster& rays,
                                                              const planning::TargetParams& params);

}  // namespace dollytrack::cli
