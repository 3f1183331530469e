#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "planning/free_space/free_space.h"

namespace dollytrack::planning {

/// Share of the directions from evenly chosen positions in the rooms' free space whose rays hit a
/// surface of the scene, 0..1. It is 1 in closed rooms, less in open ones and in scans with missing
/// surfaces. A ray that hits only a floor added under a point cloud counts as a miss.
[[nodiscard]] double surfaceCoverage(const Scene& scene, const RayCaster& rays,
                                     const FreeSpace& map);

}  // namespace dollytrack::planning
