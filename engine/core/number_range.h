#pragma once

#include <string>

namespace dollytrack {

/// The values that a number can take.
struct NumberRange {
    double min = 0.0;
    double max = 1.0;
    // Where 0 stands for something of its own, "none" or "automatic": what all others are at least.
    double least_above_zero = 0.0;

    [[nodiscard]] bool has(double value) const;  // not NaN
    [[nodiscard]] double nearest(double value) const;
    [[nodiscard]] std::string text() const;  // "0.1 .. 1" or "0, or 1000 .. 20000"
};

}  // namespace dollytrack
