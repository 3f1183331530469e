#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dollytrack::statistics {

/// A name from a file as HTML text. Names longer than `most_bytes` are shortened.
[[nodiscard]] std::string shownName(std::string_view name, std::size_t most_bytes = 60);

}  // namespace dollytrack::statistics
