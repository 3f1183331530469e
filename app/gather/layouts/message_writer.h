#pragma once

#include "app/gather/layouts/record_bytes.h"
#include "app/gather/layouts/ros_messages.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace dollytrack::gather::ros {

/// Serialises the fields of a message, one after the other, in little endian. ROS 1 packs the
/// fields without padding. ROS 2 uses OMG CDR (XCDR version 1), called "cdr": each number is
/// aligned to its own size, counted from the end of the four bytes of the encapsulation header, and
/// strings end with a zero byte, which their length includes.
class MessageWriter {
  public:
    explicit MessageWriter(Version version) : is_cdr_(version == Version::Ros2) {
        if (is_cdr_) bytes_.assign("\x00\x01\x00\x00", kHeaderBytes);  // CDR, little endian
    }

    [[nodiscard]] Version version() const { return is_cdr_ ? Version::Ros2 : Version::Ros1; }

    template <class Number>
    void number(Number value) {
        static_assert(sizeof(Number) <= 8);
        if (is_cdr_) {
            bytes_.resize(kHeaderBytes + (bytes_.size() - kHeaderBytes + sizeof(value) - 1) /
                                             sizeof(value) * sizeof(value));
        }
        put(bytes_, value);
    }

    /// An array of fixed length.
    void numbers(std::span<const double> values) {
        for (const double value : values) number(value);
    }

    /// The length of a sequence; its elements follow.
    void count(std::size_t elements) { number(static_cast<std::uint32_t>(elements)); }

    void text(std::string_view value) {
        count(value.size() + (is_cdr_ ? 1 : 0));
        bytes_ += value;
        if (is_cdr_) bytes_ += '\0';
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
    bool is_cdr_ = false;
    std::string bytes_;
};

}  // namespace dollytrack::gather::ros
