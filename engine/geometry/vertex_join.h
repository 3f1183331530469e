#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace dollytrack {

/// Numbers equal vertices alike, in order of first appearance: an open-addressing hash set of
/// `N` floats each. -0 and 0 are equal; NaN must not come here.
template <std::size_t N>
class VertexJoin {
  public:
    explicit VertexJoin(std::size_t expected) {
        slots_.assign(std::bit_ceil(2 * expected + 8), kEmpty);
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

    /// Where the key is, or would go.
    [[nodiscard]] std::size_t slotOf(const Bits& bits) const {
        std::uint64_t hash = 0x9E3779B97F4A7C15ULL;
        for (const std::uint32_t word : bits) {
            hash = (hash ^ word) * 0xD6E8FEB86659FD93ULL;
            hash ^= hash >> 32;
        }
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = hash & mask;
        while (slots_[at] != kEmpty && keys_[slots_[at]] != bits) at = (at + 1) & mask;
        return at;
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
