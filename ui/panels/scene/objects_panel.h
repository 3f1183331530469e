#pragma once

#include "engine/document/edits.h"
#include "engine/plan/capture.h"
#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace dollytrack::ui {

/// What the panel may read this frame.
struct ObjectsView {
    const Scene* scene = nullptr;
    const std::vector<ObjectCapture>* captures = nullptr;  // by rising id; null before planning
    const std::vector<int>* selected = nullptr;            // ids
    const std::vector<bool>* hidden = nullptr;             // by id
    const Edits* edits = nullptr;  // the newest, which the scene may not have yet
};

/// What the panel remembers between frames.
struct ObjectsPanelState {
    std::string filter;
    int shown = 1;                   // index of the choice "all, targets, not captured, …"
    int scroll_to = 0;               // id to be brought into view
    bool pressed_with_ctrl = false;  // Ctrl may be up again when the button is
};

/// What the user asked for; ids of objects, 0: nothing.
struct ObjectsActions {
    int clicked = 0;
    bool add_to_selection = false;  // with Ctrl
    int frame = 0;                  // double click: bring it into the viewport
    int toggle_hidden = 0;
    int toggle_target = 0;
    bool make_target = false;  // what `toggle_target` is to become
};

/// The scene's objects: searchable, with class, size class, captured state, eye and target switch.
ObjectsActions drawObjectsPanel(const ObjectsView& view, ObjectsPanelState& state);

}  // namespace dollytrack::ui
