#pragma once

#include "engine/document/edits.h"
#include "engine/plan/capture.h"
#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace dollytrack::ui {

/// Input of the panel for one window frame.
struct ObjectsView {
    const Scene* scene = nullptr;
    const std::vector<ObjectCapture>* captures = nullptr;  // sorted by id; null before planning
    const std::vector<int>* selected = nullptr;            // ids of the selected objects
    const std::vector<bool>* hidden = nullptr;             // indexed by id
    const Edits* edits = nullptr;  // the newest; the scene may not contain them yet
};

/// State kept between window frames.
struct ObjectsPanelState {
    std::string filter;
    int shown = 1;              // index of the shown group: all, targets, not captured, …
    int scroll_to = 0;          // id of the row to scroll to; 0: none
    int anchor = 0;             // object clicked last without Shift, from which ranges begin
    float name_width = 200.0F;  // of the column of names, px
    struct ShownNames {
        std::vector<std::string> whole;
        std::vector<std::string> cut;  // to `width`
        float width = 0.0F;
    } names;
    // Keys at the press of the button, which may be released before it.
    bool pressed_with_ctrl = false;
    bool pressed_with_shift = false;
};

/// User actions of this frame; ids of objects, 0: none.
struct ObjectsActions {
    int clicked = 0;
    bool add_to_selection = false;  // with Ctrl
    std::vector<int> range;         // with Shift: ids from the anchor to the clicked row
    int frame = 0;                  // double click: frame the object in the viewport
    int right_clicked = 0;
    int toggle_hidden = 0;
    int toggle_target = 0;
    bool make_target = false;  // whether `toggle_target` becomes a target
};

/// Draws the scene's objects as a searchable table with capture state, name, class, size class, and
/// switches for visibility and target.
ObjectsActions drawObjectsPanel(const ObjectsView& view, ObjectsPanelState& state);

}  // namespace dollytrack::ui
