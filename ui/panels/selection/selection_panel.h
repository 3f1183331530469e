#pragma once

#include "engine/document/edits.h"
#include "engine/plan/plan.h"
#include "ui/edit_request.h"
#include "ui/panels/selection/selection_remedy.h"
#include "ui/selection.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::planning {
class FreeSpace;
}

namespace dollytrack::ui {

/// What the panel may read this frame.
struct SelectionView {
    const Selection* selection = nullptr;
    const Scene* scene = nullptr;                     // on the screen; null: no project is open
    const Plan* plan = nullptr;                       // of that scene; null before planning
    bool measured = false;                            // the captures belong to this plan
    const Edits* edits = nullptr;                     // the newest; may be ahead of scene and plan
    const planning::FreeSpace* free_space = nullptr;  // null before planning
    RemedySearch remedy;                              // of the selected object
    double track_time_s = 0.0;                        // at which objects' tracks are looked at
    const std::vector<double>* piece_sizes_m = nullptr;  // of the object; null: being measured
};

/// What the panel remembers between frames.
struct SelectionState {
    bool show_candidates = true;  // of the selected target, in the viewport
    std::string class_filter;
    std::string merge_name;
    SplitLimits split;
};

/// What the user asked for.
struct SelectionActions {
    EditRequest edit;
    std::optional<Selection> select;
    bool frame = false;  // bring what is selected into the viewport
    int go_to_frame = -1;
    std::optional<Pose> look_through;
    RemedyActions remedy;
    std::optional<double> went_to_s;  // the time of the tracks that `edit` goes to
};

/// What is known of the thing that was clicked, why the plan treats it as it does, and what can be
/// changed of it.
SelectionActions drawSelectionPanel(const SelectionView& view, SelectionState& state);

/// The operation that splits an object; limits that are off are not in it.
nlohmann::json splitOperation(const nlohmann::json& object, const SplitLimits& limits);
/// Why a split would make nothing of the selected object; empty where it would, or where the pieces
/// are not known yet.
std::string whyNoSplit(const SelectionView& view, const SplitLimits& limits);
/// The operation that gives an object's track a key at this time, where the object now is.
nlohmann::json addKeyOperation(const Edits& edits, const Scene& scene, int id, double time_s);
/// And the one that takes it away; null where there is none.
nlohmann::json removeKeyOperation(const Edits& edits, const Scene& scene, int id, double time_s);

}  // namespace dollytrack::ui
