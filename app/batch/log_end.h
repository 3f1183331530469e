#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace dollytrack::batch {

/// The last `bytes` of a log, from the beginning of a line; empty where it cannot be read.
[[nodiscard]] std::string endOf(const std::filesystem::path& log, std::size_t bytes);

}  // namespace dollytrack::batch
