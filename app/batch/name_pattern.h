#pragma once

#include <string>
#include <string_view>

namespace dollytrack::batch {

/// Whether a file's name fits a pattern of '*', '?' and '[...]', as fnmatch() with FNM_PERIOD says,
/// but in time that grows with the product of both lengths: fnmatch() tries every way to share a
/// name among several '*'.
[[nodiscard]] bool fitsFilePattern(std::string_view name, const std::string& pattern);

}  // namespace dollytrack::batch
