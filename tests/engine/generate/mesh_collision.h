#pragma once

#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace dollytrack::test {

/// Pairs of objects whose triangles intersect, by exact predicates, as "Chair 1 - Table 1". `skip`:
/// whether a pair may touch.
std::vector<std::string> collisionsIn(const Scene& scene,
                                      bool (*skip)(const Object& a, const Object& b));

}  // namespace dollytrack::test
