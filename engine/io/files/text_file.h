#pragma once

#include "engine/core/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace dollytrack {

/// What is read whole into memory, where nothing else is said.
inline constexpr std::uint64_t kMostTextBytes = std::uint64_t{512} << 20U;

/// The whole of an ordinary file of up to `most_mebibytes`; see readNamedFile(). Error: BadInput.
[[nodiscard]] Result<std::string> readText(const std::filesystem::path& path,
                                           std::size_t most_mebibytes = 512);

}  // namespace dollytrack
