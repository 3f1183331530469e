#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Core>

namespace dollytrack::render {

/// Distance (m) from a point along a unit vector to the first surface whose object satisfies
/// counts(object); at most `far`. Gives up after 64 surfaces and returns `far`.
template <class Counts>
double distanceTo(const Scene& scene, const RayCaster& rays, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& way, double far, Counts&& counts) {
    constexpr int kMostSurfaces = 64;
    double at = 0.0;
    for (int i = 0; i < kMostSurfaces; ++i) {
        const RayHit hit = rays.cast(from, way, far, at);
        if (hit.object_id == 0) return far;
        if (counts(scene.object(hit.object_id))) return hit.distance;
        at = hit.distance + 1e-5;
    }
    return far;
}

}  // namespace dollytrack::render
