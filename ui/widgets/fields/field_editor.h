#pragma once

#include "engine/core/field_list.h"
#include "ui/widgets/fields/number_input.h"

#include <string>

namespace dollytrack::ui {

/// What the user should know about the current value of a field; empty: nothing.
struct FieldNotes {
    /// Another parameter and its value with which this one has no effect, for example "shake=none".
    /// The row is dimmed then, and the tooltip gives that reason; the value can still be edited.
    std::string no_effect_with;
    std::string note;  // below the field and in the tooltip
};

/// Draws a row of a two-column table: name, widget with unit, and a reset button if the value
/// differs from `standard` (the same field of a default-constructed struct). The tooltip shows
/// description, range, default and the symbol in the method's paper. `path` is the widget's name in
/// the item map: "parameters.fill".
FieldEdit drawField(const Field& field, const Field& standard, const std::string& path,
                    const FieldNotes& notes = {});

/// Draws only the widget, with the width set by SetNextItemWidth().
FieldEdit drawFieldValue(const Field& field, const Field& standard, const std::string& path);

/// The display name: "corner distance" for "corner_distance_m".
[[nodiscard]] std::string readableName(const Field& field);

}  // namespace dollytrack::ui
