#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace dollytrack {

/// Welds equal vertices: insert() returns the same number for equal ones, counted in order of first
/// appearance. An open-addressing hash set of `N` floats each. -0 equals 0; NaN is not allowed.
template <std::size_t N>
class VertexJoin {
  public:
    explicit VertexJoin(std::size_t expected) {
        // Files repeat most corners, so a small table that grows beats a large, cold one.
        slots_.assign(std::bit_ceil(expected / 2 + 8), kEmpty);
        keys_.reserve(expected);
    }

    std::uint32_t insert(const std::array<float, N>& key) {
        Bits bits;
        for (std::size_t i = 0; i < N; ++i) {
            bits[i] = std::bit_cast<std::uint32_t>(key[i] + 0.0F);  // -0 becomes 0
        }
        if (2 * keys_.size() >= slots_.size()) grow();
        const std::size_t at = slotOf(bits);
        if (slots_[at] != kEmpty) return slots_[at];
        slots_[at] = static_cast<std::uint32_t>(keys_.size());
        keys_.push_back(bits);
        return slots_[at];
    }

    [[nodiscard]] std::size_t size() const { return keys_.size(); }

  private:
    using Bits = std::array<std::uint32_t, N>;

    /// The slot of the key, or the free slot where it would be inserted.
    [[nodiscard]] std::size_t slotOf(const Bits& bits) const {
        // Each word by an odd factor of its own: the products do not wait for each other.
        std::uint64_t hash = 0;
        std::uint64_t factor = 0x9E3779B97F4A7C15ULL;
        for (const std::uint32_t word : bits) {
            hash += (word + 0x7F4A7C15ULL) * factor;
            factor *= 0xD6E8FEB86659FD93ULL;
        }
        hash = (hash ^ (hash >> 32)) * 0xD6E8FEB86659FD93ULL;
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = (hash >> 32) & mask;
        while (slots_[at] != kEmpty && !equal(keys_[slots_[at]], bits)) at = (at + 1) & mask;
        return at;
    }

    static bool equal(const Bits& a, const Bits& b) {
        std::uint32_t difference = 0;
        for (std::size_t i = 0; i < N; ++i) difference |= a[i] ^ b[i];
        return difference == 0;
    }

    void grow() {
        slots_.assign(2 * slots_.size(), kEmpty);
        for (std::size_t i = 0; i < keys_.size(); ++i) {
            slots_[slotOf(keys_[i])] = static_cast<std::uint32_t>(i);
        }
    }

    static constexpr std::uint32_t kEmpty = 0xFFFFFFFFU;
    std::vector<std::uint32_t> slots_;
    std::vector<Bits> keys_;
};

}  // namespace dollytrack
