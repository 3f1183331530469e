#pragma once

#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace dollytrack::test {

/// Pairs of objects, "Chair 1 - Table 1", of which a triangle of one meets a triangle of the other,
/// by exact predicates. `skip` says which pairs may touch.
std::vector<std::string> collisionsIn(const Scene& scene,
                                      bool (*skip)(const Object& a, const Object& b));

}  // namespace dollytrack::test
