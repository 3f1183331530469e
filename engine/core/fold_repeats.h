#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack {

/// Messages of one kind, those that differ in quoted names and numbers alone, are kept up to
/// `shown` times; the last one kept tells how many more there were. The order stays.
[[nodiscard]] std::vector<std::string> foldRepeats(const std::vector<std::string>& messages,
                                                   std::size_t shown = 10);

}  // namespace dollytrack
