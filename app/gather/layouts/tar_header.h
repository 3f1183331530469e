#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace dollytrack::gather {

/// A tar file consists of blocks of this size.
inline constexpr std::size_t kTarBlock = 512;

/// The header of a file in a tar archive (POSIX ustar), without owner and time, so that equal files
/// give equal bytes. The name has at most 100 bytes, the file at most 8 GiB.
[[nodiscard]] std::array<char, kTarBlock> tarHeader(const std::string& name, std::uint64_t bytes);

/// How many bytes a file takes in an archive, its header included.
[[nodiscard]] constexpr std::uint64_t tarBytes(std::uint64_t bytes) {
    return kTarBlock + (bytes + kTarBlock - 1) / kTarBlock * kTarBlock;
}

}  // namespace dollytrack::gather
