#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dollytrack::io {

/// Unpacks LZF, the compression inside PCD files: runs of literal bytes, and copies of what came
/// before. Nothing when the data do not give exactly `size` bytes or point outside of them.
std::optional<std::vector<std::uint8_t>> unpackLzf(std::span<const std::uint8_t> packed,
                                                   std::size_t size);

}  // namespace dollytrack::io
