#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace dollytrack {

/// Quantile with linear interpolation between neighbouring values. `sorted` must not be empty;
/// `share` lies in 0 .. 1.
inline double quantile(std::span<const double> sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - std::floor(at)) * (sorted[above] - sorted[below]);
}

}  // namespace dollytrack
