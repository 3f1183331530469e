#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace dollytrack::view {

/// Bytes as base64 (RFC 4648, with padding).
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

/// How long the text of so many bytes is.
[[nodiscard]] constexpr std::size_t base64Length(std::size_t bytes) {
    return (bytes + 2) / 3 * 4;
}

}  // namespace dollytrack::view
