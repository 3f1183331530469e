#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

namespace dollytrack::verify {

/// The normal that the scene's corners have where a ray along a unit vector meets it, in the world,
/// on the side that is seen; zero of a triangle without area. Of a smoothed face it may look a
/// little past the outline, where it is laid along it.
Eigen::Vector3d cornersNormal(const Scene& scene, const RayHit& hit, const Eigen::Vector3d& place,
                              const Eigen::Vector3d& along);

}  // namespace dollytrack::verify
