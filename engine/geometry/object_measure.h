#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// Computes the box and centroid of an object from its vertices and triangles.
void measureObject(const Scene& scene, Object& object);

}  // namespace dollytrack
