#pragma once

#include <string>
#include <string_view>

namespace dollytrack::batch {

/// Whether a file name matches a pattern of '*', '?' and '[...]', like fnmatch() with FNM_PERIOD,
/// but in time proportional to the product of both lengths; fnmatch() can take exponential time
/// with several '*'.
[[nodiscard]] bool fitsFilePattern(std::string_view name, const std::string& pattern);

}  // namespace dollytrack::batch
