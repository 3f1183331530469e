#include "engine/io/sandbox/binary_archive.h"

#include <array>
#include <bit>

namespace dollytrack {
namespace {

// An arbitrary odd number, so that multiplication by it is invertible.
constexpr std::uint64_t kFactor = 0xD6E8FEB86659FD93ULL;

std::uint64_t step(std::uint64_t sum, std::uint64_t word) {
    return std::rotl((sum ^ word) * kFactor, 29);
}

}  // namespace

std::uint64_t checksumOf(std::span<const std::uint8_t> bytes) {
    // Four independent sums, so that multiplications can overlap.
    std::array<std::uint64_t, 4> sums = {1, 2, 3, 4};
    std::size_t at = 0;
    for (; at + 32 <= bytes.size(); at += 32) {
        std::array<std::uint64_t, 4> words{};
        std::memcpy(words.data(), bytes.data() + at, 32);
        for (std::size_t i = 0; i < 4; ++i) sums[i] = step(sums[i], words[i]);
    }
    std::uint64_t sum = bytes.size();
    for (const std::uint64_t one : sums) sum = step(sum, one);
    for (; at < bytes.size(); ++at) sum = step(sum, bytes[at]);
    return sum ^ (sum >> 32U);
}

}  // namespace dollytrack
