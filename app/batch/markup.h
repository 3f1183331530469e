#pragma once

#include <string>
#include <string_view>

namespace dollytrack::batch {

/// Escapes text for XML and HTML content and attributes, and removes characters that XML does not
/// allow.
[[nodiscard]] std::string asMarkup(std::string_view text);

/// Percent-encodes a relative path for a link.
[[nodiscard]] std::string asLink(std::string_view path);

}  // namespace dollytrack::batch
