#pragma once

#include "engine/io/gltf/json_fields.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::gltf {

/// Decodes a buffer view that is packed with EXT_meshopt_compression; `description` is the
/// extension's JSON object. Fault: the data is damaged, or shorter than the description says.
[[nodiscard]] std::vector<std::uint8_t> unpackMeshopt(std::span<const std::uint8_t> packed,
                                                      const Json& description);

}  // namespace dollytrack::gltf
