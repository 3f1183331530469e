#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Geometry>

namespace dollytrack::planning {

/// Unit normal of the triangle that a ray hit, flipped to face the ray's origin.
inline Eigen::Vector3f facingNormal(const Scene& scene, const RayHit& hit,
                                    const Eigen::Vector3d& direction) {
    const Triangle& triangle = scene.triangles[hit.triangle];
    const Eigen::Vector3f& a = scene.positions[triangle[0]];
    const Eigen::Vector3f normal =
        (scene.positions[triangle[1]] - a).cross(scene.positions[triangle[2]] - a).normalized();
    return normal.dot(direction.cast<float>()) <= 0.0F ? normal : Eigen::Vector3f(-normal);
}

}  // namespace dollytrack::planning
