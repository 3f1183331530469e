#pragma once

#include "engine/core/result.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace dollytrack::io {

/// The whole of an ordinary file of up to `most_mebibytes`; see readNamedFile(). Error: BadInput.
[[nodiscard]] Result<std::string> readText(const std::filesystem::path& path,
                                           std::size_t most_mebibytes = 512);

}  // namespace dollytrack::io
