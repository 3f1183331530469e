#pragma once

#include "engine/io/gltf/document.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::gltf {

/// The values of an accessor, element after element. Normalised integers are scaled to -1..1 or
/// 0..1.
struct Elements {
    std::size_t count = 0;
    std::size_t components = 0;  // of an element: 1 to 4
    std::vector<float> values;
};

/// Reads a scalar or vector accessor, sparse or not. Fault: its bytes are not all in the file.
[[nodiscard]] Elements readElements(const Document& document, std::size_t accessor);

/// Reads an accessor of vertex indices. Fault: as above, or they are not unsigned integers.
[[nodiscard]] std::vector<std::uint32_t> readIndices(const Document& document,
                                                     std::size_t accessor);

}  // namespace dollytrack::gltf
