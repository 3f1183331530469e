#pragma once

#include "engine/scene/scene.h"
#include "render/gpu_scene.h"

#include <vector>

namespace dollytrack::render {

/// Of a cut-out, texels whose opacity is below are holes.
constexpr float kHoleBelow = 0.5F;

[[nodiscard]] inline bool isTextured(const Scene& scene, const Material& material) {
    return material.texture >= 0 && scene.textures[material.texture].width > 0;
}

/// How each material is shown, drawn or traced.
[[nodiscard]] std::vector<Surface> surfaceKinds(const Scene& scene);

}  // namespace dollytrack::render
