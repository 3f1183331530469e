#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::render {

/// Shading normal at a ray hit: world frame, unit length, on the ray's side, computed as in
/// assets/shaders/surface.frag (without normal maps).
/// @param to_rest  by object id: the transform from the current position to that in `scene`
///     (MovingObjects::toRest()); empty if nothing moves
[[nodiscard]] Eigen::Vector3d shadingNormal(const Scene& scene,
                                            const std::vector<Eigen::Isometry3d>& to_rest,
                                            const RayHit& hit, const Eigen::Vector3d& origin,
                                            const Eigen::Vector3d& direction);

}  // namespace dollytrack::render
