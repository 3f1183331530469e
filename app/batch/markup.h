#pragma once

#include <string>
#include <string_view>

namespace dollytrack::batch {

/// Text as content or attribute of XML and HTML: escaped, and without what XML has no place for.
[[nodiscard]] std::string asMarkup(std::string_view text);

/// A relative path as a link, its unusual bytes as %20 and the like.
[[nodiscard]] std::string asLink(std::string_view path);

}  // namespace dollytrack::batch
