#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::render {

/// The shading normal where a ray meets the scene, world, of unit length, on the side that is seen;
/// as assets/shaders/surface.frag has it. `to_rest` leads each object, by id, to where the scene
/// has it (MovingObjects::toRest()); empty where nothing moves.
[[nodiscard]] Eigen::Vector3d seenNormal(const Scene& scene,
                                         const std::vector<Eigen::Isometry3d>& to_rest,
                                         const RayHit& hit, const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction);

}  // namespace dollytrack::render
