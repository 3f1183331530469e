#pragma once

#include "engine/core/field_list.h"

#include <initializer_list>
#include <string>
#include <string_view>

namespace dollytrack::ui {

/// An edit of one of a row's parameters.
struct ParameterRowEdit {
    std::string name;       // name of the parameter; empty: none was changed
    bool finished = false;  // the edit is complete and becomes one undo step
};

/// The field with this name; null if there is none.
[[nodiscard]] const Field* fieldNamed(const FieldList& fields, std::string_view name);

/// Draws widgets for the named parameters side by side, sharing the rest of the line; unknown names
/// are skipped. In the item map each is called `path`.name: "export.antialias".
ParameterRowEdit drawParameterRow(const FieldList& fields, const FieldList& standard,
                                  std::initializer_list<std::string_view> names,
                                  const std::string& path);

}  // namespace dollytrack::ui
