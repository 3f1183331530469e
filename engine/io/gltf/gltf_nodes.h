#pragma once

#include "engine/io/gltf/document.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace dollytrack::gltf {

/// One placement of a mesh in the scene.
struct MeshPlacement {
    std::size_t mesh = 0;  // index into the file's meshes
    int node = 0;          // index into RawScene::nodes
    Eigen::Affine3d source_from_mesh;
};

/// Walks the nodes of the default scene (of the whole file if it has no scenes) and fills the
/// scene's nodes. Each instance of EXT_mesh_gpu_instancing becomes a node. Fault: a node is its own
/// ancestor or has two parents; nodes are nested too deeply; there are too many instances.
[[nodiscard]] std::vector<MeshPlacement> placeMeshes(const Document& document, RawScene& raw);

}  // namespace dollytrack::gltf
