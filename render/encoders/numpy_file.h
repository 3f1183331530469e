#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// A NumPy file (.npy, version 1.0) of an array in C order. `type` is NumPy's type string: "<f4"
/// for float32, "|u1" for uint8.
[[nodiscard]] std::vector<std::uint8_t> numpyBytes(std::string_view type,
                                                   const std::vector<int>& shape,
                                                   std::span<const std::uint8_t> values);

}  // namespace dollytrack::render
