#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dollytrack {

/// Unpacks LZF, the compression of PCD files: runs of literal bytes, and copies of earlier output.
/// Returns nullopt if the data do not give exactly `size` bytes or refer to bytes outside.
std::optional<std::vector<std::uint8_t>> unpackLzf(std::span<const std::uint8_t> packed,
                                                   std::size_t size);

}  // namespace dollytrack
