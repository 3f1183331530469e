#pragma once

#include "engine/scene/scene.h"

#include <string>

namespace dollytrack::render {

/// SHA-256 of the scene's geometry: vertices, triangles, and each object's name and class.
[[nodiscard]] std::string geometryHash(const Scene& scene);

/// SHA-256 of the scene's appearance: normals, texture coordinates, materials and textures. The
/// scene file's own hash misses what lies in separate files.
[[nodiscard]] std::string appearanceHash(const Scene& scene);

}  // namespace dollytrack::render
