#pragma once

#include <string>
#include <string_view>

namespace dollytrack {

/// Text from a file as valid UTF-8 that can be printed and written as JSON: each byte (or cut-off
/// sequence) that is no UTF-8 becomes U+FFFD. Control characters are dropped, and so are
/// bidirectional embeddings, overrides and isolates (U+202A to U+202E, U+2066 to U+2069), because
/// they can make one name look like another. Clean text comes back as it is.
[[nodiscard]] std::string cleanText(std::string_view text);

/// `text` without spaces, tabs and line breaks at both ends; a view into `text`.
[[nodiscard]] std::string_view trimmed(std::string_view text);

}  // namespace dollytrack
