#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack {

/// Keeps the first `shown` messages of each kind, in their order. Messages are of one kind if they
/// differ only in quoted names and numbers. The last one kept says how many more there were.
[[nodiscard]] std::vector<std::string> foldRepeats(const std::vector<std::string>& messages,
                                                   std::size_t shown = 10);

}  // namespace dollytrack
