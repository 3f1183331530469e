#include "render/encoders/numpy_file.h"

#include <fmt/format.h>

#include <string>

namespace dollytrack::render {

std::vector<std::uint8_t> numpyBytes(std::string_view type, const std::vector<int>& shape,
                                     std::span<const std::uint8_t> values) {
    std::string sizes;
    for (const int size : shape) sizes += fmt::format("{}, ", size);
    std::string header =
        fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, sizes);
    // Padded so that the header ends with a newline and values begin at a multiple of 64.
    constexpr std::size_t kBefore = 10;
    header.resize((kBefore + header.size() + 1 + 63) / 64 * 64 - kBefore - 1, ' ');
    header += '\n';
    std::vector<std::uint8_t> bytes = {0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0};
    bytes.push_back(static_cast<std::uint8_t>(header.size() & 0xffU));
    bytes.push_back(static_cast<std::uint8_t>(header.size() >> 8U));
    bytes.insert(bytes.end(), header.begin(), header.end());
    bytes.insert(bytes.end(), values.begin(), values.end());
    return bytes;
}

}  // namespace dollytrack::render
