#include "engine/io/pointcloud/files/lzf.h"

namespace dollytrack {

std::optional<std::vector<std::uint8_t>> unpackLzf(std::span<const std::uint8_t> packed,
                                                   std::size_t size) {
    // A copy of at most 264 bytes takes at least two bytes, which limits the size.
    if (size / 264 > packed.size()) return std::nullopt;
    std::vector<std::uint8_t> out;
    out.reserve(size);
    std::size_t at = 0;
    while (at < packed.size()) {
        const std::size_t control = packed[at++];
        if (control < 32) {
            const std::size_t count = control + 1;
            if (count > packed.size() - at || count > size - out.size()) return std::nullopt;
            out.insert(out.end(), packed.begin() + static_cast<std::ptrdiff_t>(at),
                       packed.begin() + static_cast<std::ptrdiff_t>(at + count));
            at += count;
            continue;
        }
        std::size_t count = control >> 5;
        if (count == 7) {
            if (at >= packed.size()) return std::nullopt;
            count += packed[at++];
        }
        count += 2;
        if (at >= packed.size()) return std::nullopt;
        const std::size_t back = ((control & 31U) << 8) + packed[at++] + 1;
        if (back > out.size() || count > size - out.size()) return std::nullopt;
        // Byte by byte, because source and target may overlap.
        for (std::size_t i = 0; i < count; ++i) out.push_back(out[out.size() - back]);
    }
    if (out.size() != size) return std::nullopt;
    return out;
}

}  // namespace dollytrack
