#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "planning/free_space/free_space.h"

namespace dollytrack::planning {

/// How much of what surrounds the rooms is there: of the directions from evenly chosen places of
/// their free space, the share that ends on a surface within the scene. 1 for a closed room; less
/// for open ones, and for scans with surfaces missing. A floor that was put under a point cloud
/// does not count.
[[nodiscard]] double surfaceCoverage(const Scene& scene, const RayCaster& rays,
                                     const FreeSpace& map);

}  // namespace dollytrack::planning
