#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

namespace dollytrack::verify {

/// The shading normal at a ray hit, interpolated from the vertex normals: world frame, on the ray's
/// side; zero for a triangle without area. Near an outline, where it would point away from the
/// viewer, it is projected onto the outline.
/// @param place  the hit point, world
/// @param along  the ray's unit direction, world
Eigen::Vector3d interpolatedNormal(const Scene& scene, const RayHit& hit,
                                   const Eigen::Vector3d& place, const Eigen::Vector3d& along);

}  // namespace dollytrack::verify
