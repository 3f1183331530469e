#pragma once

#include "engine/document/edits.h"
#include "engine/plan/plan.h"
#include "ui/edit_request.h"
#include "ui/selection.h"

#include <optional>

namespace dollytrack::ui {

/// What the panel may read this frame.
struct EditsView {
    const Edits* edits = nullptr;  // null: no project is open
    const Scene* scene = nullptr;  // edited
    const Plan* plan = nullptr;    // null before planning
    bool plan_is_current = false;  // it was made with these edits
    double min_height_m = 0.0;
    double max_height_m = 100.0;
    OrientedBox new_box;                          // on what is in the middle of the view
    std::optional<OrientedBox> around_selection;  // a new box around what is selected
};

/// What the user asked for.
struct EditsActions {
    EditRequest edit;
    std::optional<Selection> select;
    std::optional<Pose> look_through;
    std::optional<OrientedBox> frame;  // bring it into the viewport
};

/// Everything that was changed by hand, and the means to take it back.
EditsActions drawEditsPanel(const EditsView& view);

}  // namespace dollytrack::ui
