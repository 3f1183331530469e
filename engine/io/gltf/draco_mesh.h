#pragma once

#include "engine/io/gltf/accessor.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dollytrack::gltf {

/// A decoded KHR_draco_mesh_compression mesh: triangles, and attributes by name.
struct DracoMesh {
    std::vector<std::uint32_t> indices;
    std::map<std::string, Elements> attributes;
};

/// Decodes the mesh of a primitive. `description` is the extension's JSON object; `normalized`
/// tells for each attribute whether its integers are normalised. Fault: the data is damaged.
[[nodiscard]] DracoMesh unpackDraco(const Document& document, const Json& description,
                                    const std::map<std::string, bool>& normalized);

}  // namespace dollytrack::gltf
