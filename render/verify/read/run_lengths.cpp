#include "render/verify/read/run_lengths.h"

#include <numeric>

namespace dollytrack::verify {
namespace {

/// Reads one number: groups of five bits, lowest first, as characters from '0' on. Bit 32 means
/// that another group follows, bit 16 in the last one that the number is negative. Returns false if
/// the text ends early or is invalid.
bool readNumber(std::string_view& text, std::int64_t& number) {
    std::uint64_t bits = 0;
    for (unsigned shift = 0; shift < 60; shift += 5) {
        if (text.empty() || text.front() < '0' || text.front() > 'o') return false;
        const auto group = static_cast<std::uint64_t>(text.front() - '0');
        text.remove_prefix(1);
        bits |= (group & 31U) << shift;
        if ((group & 32U) != 0) continue;
        if ((group & 16U) != 0) bits |= ~std::uint64_t{0} << (shift + 5);
        number = static_cast<std::int64_t>(bits);
        return true;
    }
    return false;
}

}  // namespace

std::vector<std::uint32_t> readRunLengths(std::string_view text) {
    std::vector<std::uint32_t> runs;
    while (!text.empty()) {
        std::int64_t number = 0;
        if (!readNumber(text, number)) return {};
        // The first three values are plain, later ones differences to the value before the previous
        // one.
        if (runs.size() >= 3) number += runs[runs.size() - 2];
        if (number < 0 || number > std::int64_t{0xffffffff}) return {};
        runs.push_back(static_cast<std::uint32_t>(number));
    }
    return runs;
}

std::vector<std::uint8_t> maskFrom(const std::vector<std::uint32_t>& runs, int width, int height) {
    const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (std::accumulate(runs.begin(), runs.end(), std::size_t{0}) != size) return {};
    std::vector<std::uint8_t> mask;
    mask.reserve(size);
    std::uint8_t inside = 0;
    for (const std::uint32_t run : runs) {
        mask.insert(mask.end(), run, inside);
        inside ^= 1U;
    }
    return mask;
}

}  // namespace dollytrack::verify
