#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace dollytrack::batch {

/// Up to the last `bytes` of a log, starting at a line; empty if it cannot be read.
[[nodiscard]] std::string endOf(const std::filesystem::path& log, std::size_t bytes);

}  // namespace dollytrack::batch
