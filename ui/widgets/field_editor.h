#pragma once

#include "engine/core/field_list.h"

#include <string>

namespace dollytrack::ui {

/// What the user did to a field this frame. While dragging, `changed` comes often, and `finished`
/// once at the end; both together make one step of undo.
struct FieldEdit {
    bool changed = false;
    bool finished = false;
    bool reset = false;  // back to the default
};

/// One row: name with the paper's symbol, widget, unit, and a button that resets it where it
/// differs from `standard` (the same field of a default-constructed struct). The tooltip has the
/// text and the range. `path` names the widgets: "parameters.fill". Inside a table of two columns.
FieldEdit drawField(const Field& field, const Field& standard, const std::string& path);

/// "corner_distance_m" as people read it: "corner distance".
[[nodiscard]] std::string readableName(const Field& field);

}  // namespace dollytrack::ui
