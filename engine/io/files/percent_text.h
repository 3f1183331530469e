#pragma once

#include <string>
#include <string_view>

namespace dollytrack {

/// "a%20b" as "a b", as glTF and Collada write names of files.
[[nodiscard]] std::string percentDecoded(std::string_view text);

}  // namespace dollytrack
