#pragma once

#include "engine/core/field_list.h"

#include <initializer_list>
#include <string>
#include <string_view>

namespace dollytrack::ui {

/// What was done to one of a row's parameters.
struct ParameterRowEdit {
    std::string name;       // of the parameter; empty: none was changed
    bool finished = false;  // with the mouse let go: one step of undo
};

/// The field of that name, or null.
[[nodiscard]] const Field* fieldNamed(const FieldList& fields, std::string_view name);

/// Widgets of some of a project's parameters beside each other, in what is left of the line. They
/// are named `path` and the parameter's name: "export.antialias".
ParameterRowEdit drawParameterRow(const FieldList& fields, const FieldList& standard,
                                  std::initializer_list<std::string_view> names,
                                  const std::string& path);

}  // namespace dollytrack::ui
