#pragma once

#include "engine/core/field_list.h"

#include <string>
#include <vector>

namespace dollytrack::ui {

/// What the panel may read this frame.
struct ParametersView {
    const FieldList* standard = nullptr;  // the same fields with their defaults
    bool has_scene = false;
    std::string* filter = nullptr;  // what the user typed into the search line
};

/// What the user did.
struct ParametersActions {
    std::string edited;     // name of the field that changed this frame
    bool finished = false;  // the drag ended: one step of undo
    bool reset_all = false;
};

/// All parameters of planning by section; edits `draft` in place.
ParametersActions drawParametersPanel(const ParametersView& view, const FieldList& draft);

}  // namespace dollytrack::ui
