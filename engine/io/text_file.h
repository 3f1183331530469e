#pragma once

#include "engine/core/result.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace dollytrack::io {

/// The whole file, or what comes through a pipe, up to `most_mebibytes`. Error: BadInput.
[[nodiscard]] Result<std::string> readText(const std::filesystem::path& path,
                                           std::size_t most_mebibytes = 512);

}  // namespace dollytrack::io
