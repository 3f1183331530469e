#pragma once

#include "engine/io/gltf/json_fields.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::gltf {

/// The bytes of a buffer view that EXT_meshopt_compression packed; `description` is what the
/// extension says of it. Fault: the bytes cannot hold what it claims, or are damaged.
[[nodiscard]] std::vector<std::uint8_t> unpackMeshopt(std::span<const std::uint8_t> packed,
                                                      const Json& description);

}  // namespace dollytrack::gltf
