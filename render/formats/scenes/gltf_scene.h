#pragma once

#include "engine/core/result.h"
#include "engine/scene/scene.h"
#include "render/formats/scenes/glb_builder.h"

#include <nlohmann/json.hpp>

namespace dollytrack::render {

/// glTF's axes from ours: its y is up, its z is our -y.
[[nodiscard]] Eigen::Quaterniond gltfFromWorld();

/// Adds a node for every object, in their order and with names as the scene's, and what they need:
/// meshes, materials, textures. A node stands in the middle of its object's box.
[[nodiscard]] Status addSceneNodes(const Scene& scene, GlbBuilder& builder,
                                   nlohmann::ordered_json& root);

}  // namespace dollytrack::render
