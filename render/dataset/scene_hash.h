#pragma once

#include "engine/scene/scene.h"

#include <string>

namespace dollytrack::render {

/// SHA-256 of the scene's shape: vertices, triangles, and what each object is and is called.
[[nodiscard]] std::string geometryHash(const Scene& scene);

/// SHA-256 of what else a picture shows: normals, materials and textures. The scene file's own hash
/// does not cover them where they lie in files beside it.
[[nodiscard]] std::string appearanceHash(const Scene& scene);

}  // namespace dollytrack::render
