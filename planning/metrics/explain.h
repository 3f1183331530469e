#pragma once

#include "engine/plan/plan.h"

#include <string>

namespace dollytrack::planning {

/// One sentence on why no frame captures an object: what happened to most of the places tried for
/// it, or where a legal view was lost on the way.
std::string explainUncaptured(const Scene& scene, const Plan& plan, int object_id);

}  // namespace dollytrack::planning
