#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/io/settings/annotation_file.h"
#include "planning/plan_params.h"
#include "render/frames/object_motion.h"

#include <vector>

namespace dollytrack::cli {

/// What stands on, lies in or hangs on what, floors and walls among it, for the dataset.
[[nodiscard]] std::vector<render::ObjectRelation> relationsOf(const Scene& scene,
                                                              const RayCaster& rays,
                                                              const planning::TargetParams& params);

/// What people say of it in the annotations comes before what was found: of each object that they
/// name, theirs alone count. Objects that this scene does not have are left out with a warning.
void overrideRelations(const Scene& scene, const std::vector<io::AnnotatedRelation>& said,
                       std::vector<render::ObjectRelation>& relations);

}  // namespace dollytrack::cli
