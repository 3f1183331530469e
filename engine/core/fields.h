#pragma once

#include "engine/core/number_range.h"

#include <string_view>
#include <vector>

namespace dollytrack {

/// What every shell needs to know of one number: limits, unit, meaning, and the paper's symbol.
struct FieldInfo {
    double min = 0.0;
    double max = 0.0;
    std::string_view unit;
    std::string_view text;
    std::string_view symbol = {};
    double least_above_zero = 0.0;    // as a NumberRange has it
    std::string_view only_with = {};  // see onlyWith()

    [[nodiscard]] NumberRange range() const { return {min, max, least_above_zero}; }

    /// The same for a number that has an effect only under a condition on another field of the
    /// list: "shake=sinusoidal|handheld" or "max_frames>0".
    [[nodiscard]] FieldInfo onlyWith(std::string_view condition) const {
        FieldInfo info = *this;
        info.only_with = condition;
        return info;
    }
};

/// What every shell needs to know of an on/off switch.
struct SwitchInfo {
    std::string_view text;
};

/// What every shell needs to know of an enumeration: its values' names, in order.
struct ChoiceInfo {
    std::vector<std::string_view> names;
    std::string_view text;
    std::string_view only_with = {};  // as a FieldInfo has it
};

}  // namespace dollytrack
