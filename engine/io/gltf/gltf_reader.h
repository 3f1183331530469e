#pragma once

#include "engine/core/result.h"
#include "engine/io/gltf/document.h"
#include "engine/io/gltf/gltf_mesh.h"
#include "engine/io/import/raw_scene.h"
#include "engine/jobs/job.h"

#include <string>
#include <vector>

namespace dollytrack::gltf {

/// Reads the bytes of a glTF 2.0 file, .gltf or .glb. `where` names it in errors. Error: BadInput.
[[nodiscard]] Result<RawScene> readGltf(std::string file, const ReadBeside& read_beside,
                                        const std::string& where, const JobContext& job);

/// A file's triangles with all that its vertices carry, moved to where its nodes put them.
struct PlacedPrimitives {
    RawScene scene;  // materials and textures alone
    std::vector<Primitive> primitives;
};

/// The same for readers that need the colours of vertices. Error: BadInput.
[[nodiscard]] Result<PlacedPrimitives> readPrimitives(std::string file,
                                                      const ReadBeside& read_beside,
                                                      const std::string& where);

}  // namespace dollytrack::gltf
