#pragma once

#include "engine/core/result.h"
#include "engine/scene/scene.h"
#include "render/formats/scenes/glb_builder.h"

#include <nlohmann/json.hpp>

namespace dollytrack::render {

/// Rotation from world axes to glTF's, whose y is up and whose z is the world's -y.
[[nodiscard]] Eigen::Quaterniond gltfFromWorld();

/// Adds one node per object, in the scene's order and with the scene's names, and the meshes,
/// materials and textures they use. A node's origin is the centre of its object's box.
[[nodiscard]] Status addSceneNodes(const Scene& scene, GlbBuilder& builder,
                                   nlohmann::ordered_json& root);

}  // namespace dollytrack::render
