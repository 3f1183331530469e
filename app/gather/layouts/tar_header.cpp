#include "app/gather/layouts/tar_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string_view>

namespace dollytrack::gather {

std::array<char, kTarBlock> tarHeader(const std::string& name, std::uint64_t bytes) {
    std::array<char, kTarBlock> header = {};
    const auto put = [&](std::size_t at, std::string_view text) {
        std::ranges::copy(text, header.begin() + static_cast<std::ptrdiff_t>(at));
    };
    constexpr std::size_t kName = 100;
    constexpr std::size_t kChecksum = 148;
    put(0, std::string_view(name).substr(0, kName));
    put(100, "0000644");                      // mode
    put(108, "0000000");                      // user
    put(116, "0000000");                      // group
    put(124, fmt::format("{:011o}", bytes));  // size
    put(136, "00000000000");                  // time
    put(kChecksum, "        ");               // spaces while the checksum is computed
    put(156, "0");                            // an ordinary file
    put(257, std::string_view("ustar\00000", 8));
    const unsigned sum =
        std::accumulate(header.begin(), header.end(), 0U,
                        [](unsigned all, char c) { return all + static_cast<unsigned char>(c); });
    put(kChecksum, std::string_view(fmt::format("{:06o}", sum)));
    header[kChecksum + 6] = '\0';
    return header;
}

}  // namespace dollytrack::gather
