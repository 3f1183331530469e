#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace dollytrack::gather {

/// Serialises the fields of a ROS 2 message, one after the other, as OMG CDR (XCDR version 1) in
/// little endian, which ROS 2 calls "cdr". Each number is aligned to its own size, counted from the
/// end of the four bytes of the encapsulation header.
class CdrWriter {
  public:
    template <class Number>
    void number(Number value) {
        static_assert(std::is_arithmetic_v<Number> && sizeof(Number) <= 8);
        static_assert(std::endian::native == std::endian::little);
        bytes_.resize(kHeaderBytes + (bytes_.size() - kHeaderBytes + sizeof(value) - 1) /
                                         sizeof(value) * sizeof(value));
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    }

    /// An array of fixed length.
    void numbers(std::span<const double> values) {
        for (const double value : values) number(value);
    }

    /// The length of a sequence; its elements follow.
    void count(std::size_t elements) { number(static_cast<std::uint32_t>(elements)); }

    void text(std::string_view value) {
        count(value.size() + 1);
        bytes_ += value;
        bytes_ += '\0';
    }

    /// A sequence of uint8 that consists of two pieces.
    void bytes(std::string_view first, std::string_view second = {}) {
        count(first.size() + second.size());
        bytes_ += first;
        bytes_ += second;
    }

    /// The message. The writer must not be used afterwards.
    [[nodiscard]] std::string take() && { return std::move(bytes_); }

  private:
    static constexpr std::size_t kHeaderBytes = 4;
    std::string bytes_ = std::string("\x00\x01\x00\x00", kHeaderBytes);  // CDR, little endian
};

}  // namespace dollytrack::gather
