#pragma once

#include "engine/document/edits.h"
#include "engine/plan/plan.h"
#include "ui/edit_request.h"
#include "ui/panels/edits/motion_section.h"
#include "ui/selection.h"

#include <optional>

namespace dollytrack::ui {

/// Input of the panel for one window frame.
struct EditsView {
    const Edits* edits = nullptr;  // null: no project is open
    const Scene* scene = nullptr;  // with the edits applied
    const Plan* plan = nullptr;    // null before planning
    bool plan_is_current = false;  // the plan was made with these edits
    double min_height_m = 0.0;
    double max_height_m = 100.0;
    OrientedBox new_box;                          // "Add box": at the centre of the view
    std::optional<OrientedBox> around_selection;  // around the selection; unset: none
    MotionView motion;
};

/// User actions of this frame.
struct EditsActions {
    EditRequest edit;
    MotionActions motion;
    std::optional<Selection> select;
    std::optional<Pose> look_through;
    std::optional<OrientedBox> frame;  // move the viewport's camera to this box
};

/// Draws all manual edits, with controls to change and revert them.
EditsActions drawEditsPanel(const EditsView& view, MoveDraft& move);

}  // namespace dollytrack::ui
