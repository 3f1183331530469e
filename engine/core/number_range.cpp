#include "engine/core/number_range.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack {

bool NumberRange::has(double value) const {
    return value >= min && value <= max && (value <= 0.0 || value >= least_above_zero);
}

double NumberRange::nearest(double value) const {
    const double inside = std::clamp(value, min, max);
    return inside > 0.0 ? std::max(inside, least_above_zero) : inside;
}

std::string NumberRange::text() const {
    if (least_above_zero > 0.0) return fmt::format("{}, or {} .. {}", min, least_above_zero, max);
    return fmt::format("{} .. {}", min, max);
}

}  // namespace dollytrack
