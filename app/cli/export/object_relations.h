#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/io/settings/annotation_file.h"
#include "planning/plan_params.h"
#include "render/scene/object_motion.h"

#include <vector>

namespace dollytrack::cli {

/// Support relations for the dataset: which object is on, in or hanging on which other, including
/// floors and walls.
[[nodiscard]] std::vector<render::ObjectRelation> relationsOf(const Scene& scene,
                                                              const RayCaster& rays,
                                                              const planning::TargetParams& params);

/// Replaces detected relations by those in the annotations: for each object named there, only the
/// annotated relations count. Relations of objects that the scene does not contain (or that are
/// ambiguous) are skipped with a warning.
void overrideRelations(const Scene& scene, const std::vector<AnnotatedRelation>& said,
                       std::vector<render::ObjectRelation>& relations);

}  // namespace dollytrack::cli
