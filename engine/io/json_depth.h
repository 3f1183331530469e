#pragma once

#include <string_view>

namespace dollytrack::io {

/// What any of our files and those of data sets keep to. Parsers, copies and writers of JSON
/// recurse.
inline constexpr int kDeepestJson = 64;

/// Whether brackets of a JSON text, outside of its texts, are nested deeper than that.
[[nodiscard]] bool nestsTooDeep(std::string_view json);

}  // namespace dollytrack::io
