#pragma once

#include "engine/core/field_list.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// Input of the panel for one window frame.
struct ParametersView {
    const FieldList* standard = nullptr;  // the same fields with their defaults
    bool has_scene = false;
    std::string* filter = nullptr;                               // text of the search field
    std::map<std::string, std::string, std::less<>> notes = {};  // shown below fields, by name
};

/// User actions of this frame.
struct ParametersActions {
    std::string edited;     // name of the field that changed this frame
    bool finished = false;  // the edit is complete and becomes one undo step
    bool reset_all = false;
};

/// Draws all planning parameters by section; edits `draft` in place.
ParametersActions drawParametersPanel(const ParametersView& view, const FieldList& draft);

}  // namespace dollytrack::ui
