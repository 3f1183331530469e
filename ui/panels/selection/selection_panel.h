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

/// Input of the panel for one window frame.
struct SelectionView {
    const Selection* selection = nullptr;
    const Scene* scene = nullptr;                     // on the screen; null: no project
    const Plan* plan = nullptr;                       // plan for that scene; null before planning
    bool measured = false;                            // the plan's capture metrics are current
    const Edits* edits = nullptr;                     // the newest; may be ahead of scene and plan
    const planning::FreeSpace* free_space = nullptr;  // null before planning
    RemedySearch remedy;                              // for the selected object
    double track_time_s = 0.0;                        // time at which the tracks are evaluated
    bool keys_planned = false;                        // the plan is of the camera keys as they are
    const std::vector<double>* piece_sizes_m = nullptr;  // sizes of its pieces; null: computing
};

/// State kept between window frames.
struct SelectionState {
    bool show_candidates = true;  // draw the selected target's candidates in the viewport
    std::string class_filter;
    std::string merge_name;
    SplitLimits split;
};

/// User actions of this frame.
struct SelectionActions {
    EditRequest edit;
    std::optional<Selection> select;
    bool frame = false;  // frame the selection in the viewport
    int go_to_frame = -1;
    std::optional<Pose> look_through;
    RemedyActions remedy;
    std::optional<double> went_to_s;  // track time that `edit` sets
};

/// Draws the properties of the selection, how the plan treats it and why, and the edits it allows.
SelectionActions drawSelectionPanel(const SelectionView& view, SelectionState& state);

/// The operation that splits an object; limits of 0 (off) are omitted.
nlohmann::json splitOperation(const nlohmann::json& object, const SplitLimits& limits);
/// Why a split of the selected object would do nothing; empty if it would work, or if the pieces
/// are not computed yet.
std::string whyNoSplit(const SelectionView& view, const SplitLimits& limits);
/// The operation that sets a key of an object's track at this time to the object's current pose.
nlohmann::json addKeyOperation(const Edits& edits, const Scene& scene, int id, double time_s);
/// The operation that removes the key at exactly this time; null if there is none.
nlohmann::json removeKeyOperation(const Edits& edits, const Scene& scene, int id, double time_s);

}  // namespace dollytrack::ui
