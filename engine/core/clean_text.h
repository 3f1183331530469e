#pragma once

#include <string>
#include <string_view>

namespace dollytrack {

/// Text from a file as valid UTF-8 that can be printed and written as JSON: each byte (or cut-off
/// sequence) that is no UTF-8 becomes U+FFFD, and control characters are dropped. Clean text comes
/// back as it is.
[[nodiscard]] std::string cleanText(std::string_view text);

}  // namespace dollytrack
