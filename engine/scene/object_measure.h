#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// Sets box and centroid of an object from its own vertices and triangles in the scene.
void measureObject(const Scene& scene, Object& object);

}  // namespace dollytrack
