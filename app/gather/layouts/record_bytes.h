#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace dollytrack::gather {

/// Appends a number in little endian.
template <class Number>
void put(std::string& bytes, Number value) {
    static_assert(std::is_arithmetic_v<Number> && std::endian::native == std::endian::little);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

/// Appends the length of `value` in 32 bits, then `value`.
inline void putSized(std::string& bytes, std::string_view value) {
    put(bytes, static_cast<std::uint32_t>(value.size()));
    bytes += value;
}

}  // namespace dollytrack::gather
