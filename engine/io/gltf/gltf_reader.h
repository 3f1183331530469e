#pragma once

#include "engine/core/result.h"
#include "engine/io/gltf/document.h"
#include "engine/io/gltf/gltf_mesh.h"
#include "engine/io/gltf/gltf_nodes.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/jobs/job.h"

#include <string>
#include <vector>

namespace dollytrack::gltf {

/// Reads a glTF 2.0 file, .gltf or .glb, from its bytes. `where` names it in errors. Error:
/// BadInput.
[[nodiscard]] Result<RawScene> readGltf(std::string file, const ReadBeside& read_beside,
                                        const std::string& where, const JobContext& job);

/// The meshes of a file with vertex colours, and where they are placed.
struct ColoredMeshes {
    RawScene scene;                              // materials and textures alone
    std::vector<std::vector<Primitive>> meshes;  // of the file; empty where they are not placed
    std::vector<MeshPlacement> placements;
};

/// As readGltf(), for readers that need the colour of each vertex. Errors: BadInput, Cancelled.
[[nodiscard]] Result<ColoredMeshes> readColoredMeshes(std::string file,
                                                      const ReadBeside& read_beside,
                                                      const std::string& where,
                                                      const JobContext& job);

}  // namespace dollytrack::gltf
