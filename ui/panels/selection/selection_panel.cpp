#include "ui/panels/selection/selection_panel.h"

#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/edits/motion_section.h"
#include "ui/panels/edits/region_rows.h"
#include "ui/panels/selection/selection_details.h"
#include "ui/theme.h"
#include "ui/widgets/form.h"

#include <imgui.h>

#include <algorithm>

namespace dollytrack::ui {
namespace {

using Kind = Selection::Kind;

/// Whether the selected element exists; a new plan may have fewer elements.
bool isThere(const SelectionView& view) {
    const Selection& selection = *view.selection;
    const auto within = [](int index, std::size_t size) {
        return index >= 0 && index < static_cast<int>(size);
    };
    const auto is_object = [&](int id) { return within(id - 1, view.scene->objects.size()); };
    switch (selection.kind) {
        case Kind::None:
            return true;
        case Kind::Object:
            return selection.objects.size() == 1 && is_object(selection.objects[0]);
        case Kind::Objects:
            return std::ranges::all_of(selection.objects, is_object);
        case Kind::NoGoBox:
            return view.edits != nullptr && within(selection.index, view.edits->plan.no_go.size());
        case Kind::Region:
            return view.edits != nullptr &&
                   within(selection.index, view.edits->plan.regions.size());
        case Kind::CameraKey:
            return view.edits != nullptr && view.edits->plan.motion &&
                   within(selection.index, view.edits->plan.motion->keys.size());
        case Kind::Voxel:
            return view.free_space != nullptr;
        default:
            break;
    }
    if (view.plan == nullptr) return false;
    const Plan& plan = *view.plan;
    switch (selection.kind) {
        case Kind::ObservationPoint:
            return within(selection.index, plan.observation_points.size());
        case Kind::PositionPoint:
            return within(selection.index, plan.position_points.size());
        case Kind::Edge:
            return within(selection.index, plan.roadmap.edges.size());
        case Kind::RefusedEdge:
            return within(selection.index, plan.roadmap.refused.size());
        case Kind::Frame:
            return within(selection.index, plan.trajectory.frames.size());
        case Kind::Candidate:
            return within(selection.search, plan.searches.size()) &&
                   within(selection.search, plan.observation_points.size()) &&
                   within(selection.index, plan.searches[selection.search].candidates.size());
        default:
            return false;
    }
}

void drawNoGoBox(const SelectionView& view, SelectionActions& actions) {
    const NoGoBox& box = view.edits->plan.no_go[view.selection->index];
    heading(box.name.c_str());
    paragraph("No part of the camera's sphere may enter this box.", palette().text_dim);
    if (beginForm("box")) {
        noGoRows(box, "selection.box", actions.edit);
        endForm();
    }
    if (button("Go to", "selection.frame")) actions.frame = true;
    ImGui::SameLine();
    if (button("Delete", "selection.delete")) {
        actions.edit.operation = {{"op", "remove_no_go"}, {"name", box.name}};
    }
}

void drawRegion(const SelectionView& view, SelectionActions& actions) {
    const Region& region = view.edits->plan.regions[view.selection->index];
    heading(region.name.c_str());
    paragraph("A box that weights the objects inside, or whose surface must be seen completely.",
              palette().text_dim);
    if (beginForm("region")) {
        regionRows(region, "selection.region", actions.edit);
        endForm();
    }
    if (view.plan != nullptr) {
        if (const auto seen = seenText(*view.plan, region)) {
            paragraph(*seen, palette().text_dim);
        }
    }
    if (button("Go to", "selection.frame")) actions.frame = true;
    ImGui::SameLine();
    if (button("Delete", "selection.delete")) {
        actions.edit.operation = {{"op", "remove_region"}, {"name", region.name}};
    }
}

void drawCameraKey(const SelectionView& view, SelectionActions& actions) {
    const std::vector<MotionKey>& keys = view.edits->plan.motion->keys;
    const auto at = static_cast<std::size_t>(view.selection->index);
    const std::string title = "Key " + std::to_string(at + 1) + " of the camera path";
    heading(title.c_str());
    paragraph(
        "The camera passes this view at its time. Shift+K replaces it by the view of the viewport, "
        "K adds another key after it.",
        palette().text_dim);
    if (beginForm("camera key")) {
        formLabel("Time", "Between the times of the keys before and after it");
        keyTimeField(keys, at, "selection.key.time", actions.edit);
        formText("Position", placeText(keys[at].pose.position) + " m");
        endForm();
    }
    if (view.keys_planned && view.plan->passed_keys.size() == keys.size()) {
        const std::string& note = view.plan->passed_keys[at].note;
        if (!note.empty()) paragraph(note, palette().bad);
    }
    if (button("Look through", "selection.look", {.tip = "Fly the viewport's view here (Enter)"})) {
        actions.look_through = keys[at].pose;
    }
    ImGui::SameLine();
    if (button("Delete", "selection.delete")) actions.edit.operation = removeCameraKeyOperation(at);
}

void drawKind(const SelectionView& view, SelectionState& state, SelectionActions& actions) {
    switch (view.selection->kind) {
        case Kind::None:
            paragraph("Click something in the viewport or in a list to inspect it.",
                      palette().text_dim);
            break;
        case Kind::Object:
            drawObject(view, view.selection->objects[0], state, actions);
            break;
        case Kind::Objects:
            drawObjects(view, state, actions);
            break;
        case Kind::ObservationPoint:
            drawObservationPoint(view, actions);
            break;
        case Kind::PositionPoint:
            drawPositionPoint(view, actions);
            break;
        case Kind::Edge:
            drawEdge(view, actions);
            break;
        case Kind::RefusedEdge:
            drawRefusedEdge(view, actions);
            break;
        case Kind::Frame:
            drawFrame(view, actions);
            break;
        case Kind::Voxel:
            drawVoxel(view);
            break;
        case Kind::NoGoBox:
            drawNoGoBox(view, actions);
            break;
        case Kind::Region:
            drawRegion(view, actions);
            break;
        case Kind::Candidate:
            drawCandidate(view, actions);
            break;
        case Kind::CameraKey:
            drawCameraKey(view, actions);
            break;
    }
}

}  // namespace

SelectionActions drawSelectionPanel(const SelectionView& view, SelectionState& state) {
    SelectionActions actions;
    if (view.scene == nullptr || view.selection == nullptr) {
        ImGui::TextDisabled("No project is open.");
        return actions;
    }
    ImGui::BeginChild("selection");
    if (isThere(view)) {
        drawKind(view, state, actions);
    } else {
        paragraph(
            "The plan has changed and no longer contains the selection. Select something else.",
            palette().text_dim);
    }
    ImGui::EndChild();
    return actions;
}

}  // namespace dollytrack::ui
