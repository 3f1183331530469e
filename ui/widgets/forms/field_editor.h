#pragma once

#include "engine/core/field_list.h"
#include "ui/widgets/forms/number_input.h"

#include <string>

namespace dollytrack::ui {

/// One row: name with the paper's symbol, widget, unit, and a button that resets it where it
/// differs from `standard` (the same field of a default-constructed struct). The tooltip has the
/// text and the range. `path` names the widgets: "parameters.fill". Inside a table of two columns.
FieldEdit drawField(const Field& field, const Field& standard, const std::string& path);

/// Its widget alone, with the width set by SetNextItemWidth().
FieldEdit drawFieldValue(const Field& field, const Field& standard, const std::string& path);

/// "corner_distance_m" as people read it: "corner distance".
[[nodiscard]] std::string readableName(const Field& field);

}  // namespace dollytrack::ui
