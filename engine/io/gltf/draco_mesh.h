#pragma once

#include "engine/io/gltf/accessor.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dollytrack::gltf {

/// A mesh that KHR_draco_mesh_compression packed: triangles, and attributes by name.
struct DracoMesh {
    std::vector<std::uint32_t> indices;
    std::map<std::string, Elements> attributes;
};

/// Unpacks the mesh of a primitive; `description` is what the extension says of it, `normalized`
/// tells of which attributes the integers are fractions. Fault: it is damaged.
[[nodiscard]] DracoMesh unpackDraco(const Document& document, const Json& description,
                                    const std::map<std::string, bool>& normalized);

}  // namespace dollytrack::gltf
