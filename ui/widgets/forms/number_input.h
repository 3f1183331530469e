#pragma once

#include "engine/core/number_range.h"

#include <optional>
#include <string>

namespace dollytrack::ui {

/// What the user did to a field this frame. While dragging, `changed` comes often, and `finished`
/// once at the end; both together make one step of undo.
struct FieldEdit {
    bool changed = false;
    bool finished = false;
    bool reset = false;  // back to the default
    bool says = false;   // shows a note of its own, where a tooltip would be
};

/// Limits and looks of a number.
struct NumberLimits {
    NumberRange range;
    std::string format = "%.3f";  // printf's, without the unit
    std::string unit = {};        // with the space before it, where it has one
    bool whole = false;
    bool slides = true;        // over the whole range, else `speed` a pixel
    bool logarithmic = false;  // where it slides; min above 0
    float speed = 0.01F;
};

/// A number with the width set by SetNextItemWidth(): dragged, or typed after a double click or
/// Ctrl+click. A press that moves nothing changes nothing. What is typed out of range becomes the
/// nearest limit, and what is no number nothing; a note below (item `name`.note) says so.
FieldEdit numberInput(double& value, const NumberLimits& limits, const std::string& name);

/// What a typed text means: the value for it, if any, and what to tell the user.
struct TypedNumber {
    std::optional<double> value;
    std::string note;
};
/// A comma counts as a point, and the unit may be there.
[[nodiscard]] TypedNumber readNumber(const std::string& text, const NumberLimits& limits);

}  // namespace dollytrack::ui
