#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Encodes an OpenEXR image with one 32-bit float channel "Y", row 0 at the top, ZIP compressed.
/// Equal values give equal bytes. Returns Failed if the library fails.
[[nodiscard]] Result<std::vector<std::uint8_t>> encodeExr(int width, int height,
                                                          std::span<const float> values);

}  // namespace dollytrack::render
