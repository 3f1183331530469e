#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// An OpenEXR image of one 32-bit float channel, named Y as readers of pictures expect, rows from
/// the top, ZIP compressed. The
/// same values give the same bytes.
[[nodiscard]] Result<std::vector<std::uint8_t>> encodeExr(int width, int height,
                                                          std::span<const float> values);

}  // namespace dollytrack::render
