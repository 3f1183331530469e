#pragma once

#include "engine/io/gltf/document.h"
#include "engine/io/import/raw_scene.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace dollytrack::gltf {

/// A mesh in one place of the scene.
struct MeshPlacement {
    std::size_t mesh = 0;  // index into the file's meshes
    int node = 0;          // index into RawScene::nodes
    Eigen::Affine3d source_from_mesh;
};

/// Walks the nodes of the file's default scene, or of the whole file where it has no scenes, and
/// fills the scene's nodes. Each instance of EXT_mesh_gpu_instancing becomes a node of its own.
/// Fault: nodes that lie within themselves or in two places, that nest too deep; too many
/// instances.
[[nodiscard]] std::vector<MeshPlacement> placeMeshes(const Document& document, RawScene& raw);

}  // namespace dollytrack::gltf
