#pragma once

#include "engine/core/number_range.h"

#include <optional>
#include <string>

namespace dollytrack::ui {

/// An edit of a field in this frame. During a drag `changed` is set repeatedly and `finished` once
/// at the end; together they make one undo step.
struct FieldEdit {
    bool changed = false;
    bool finished = false;
    bool reset = false;  // reset to the default
    bool says = false;   // the field shows its own note, so no tooltip should be drawn
};

/// Limits and format of a number.
struct NumberLimits {
    NumberRange range;
    std::string format = "%.3f";  // printf format without the unit
    std::string unit = {};        // unit, including a leading space if needed
    bool whole = false;
    bool slides = true;        // slider over the range; else a drag by `speed` per pixel
    bool logarithmic = false;  // logarithmic slider; needs min > 0
    float speed = 0.01F;
};

/// A number field of the width set by SetNextItemWidth(): dragged, or typed after a double click or
/// Ctrl+click. A press without movement changes nothing. Typed values outside the range are set to
/// the nearest limit, and text that is no number is ignored; a note below the field (item
/// `name`.note) says so.
FieldEdit numberInput(double& value, const NumberLimits& limits, const std::string& name);

/// A text field with a label for a number that is only typed, and its note below. Has the keyboard
/// when its window appears. Returns whether the text is a number.
bool typedNumberField(std::string& text, const NumberLimits& limits, const std::string& name,
                      const std::string& label);

/// The value of a typed text, if valid, and a note for the user, if needed.
struct TypedNumber {
    std::optional<double> value;
    std::string note;
};
/// Parses a number. One decimal comma is accepted, and the unit may follow.
[[nodiscard]] TypedNumber readNumber(const std::string& text, const NumberLimits& limits);

}  // namespace dollytrack::ui
