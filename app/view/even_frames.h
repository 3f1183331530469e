#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dollytrack::view {

/// About `count` evenly spaced numbers below `end`, including the first and the last.
[[nodiscard]] inline std::vector<int> evenlySpaced(std::size_t count, std::size_t end) {
    std::vector<int> chosen;
    count = std::min(count, end);
    for (std::size_t i = 0; i < count; ++i) {
        chosen.push_back(static_cast<int>(count == 1 ? 0 : i * (end - 1) / (count - 1)));
    }
    return chosen;
}

}  // namespace dollytrack::view
