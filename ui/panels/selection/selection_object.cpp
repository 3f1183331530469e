#include "engine/plan/object_key.h"
#include "engine/scene/labels.h"
#include "engine/scene/move_object.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/selection/selection_details.h"
#include "ui/theme.h"
#include "ui/widgets/fields/class_combo.h"
#include "ui/widgets/fields/drag_fields.h"
#include "ui/widgets/form.h"
#include "ui/widgets/icon_button.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::ui {
namespace {

using nlohmann::json;

const char* sourceText(FrontSource source) {
    switch (source) {
        case FrontSource::Annotation:
            return "set in the scene or manually";
        case FrontSource::Wall:
            return "away from its wall";
        case FrontSource::ShortSide:
            return "across its longer side";
        case FrontSource::RoomCentre:
            return "towards the middle of the room";
    }
    return "";
}

/// An object's properties with the newest edits, which the scene on the screen may lack.
struct Said {
    int nyu40;
    Role role;
    Eigen::Vector3d front;
    std::string front_source;
    int size;  // 0: auto, 1: small, 2: large
    ObjectMove move;
};

Said whatIsSaid(const Object& object, const ObjectChange* change) {
    Said said{object.nyu40, object.role, object.front, sourceText(object.front_source), 0, {}};
    if (change == nullptr) return said;
    said.nyu40 = change->nyu40.value_or(object.nyu40);
    said.role = change->role.value_or(object.role);
    if (change->front) {
        said.front = turnLevel(*change->front, change->move.value_or(ObjectMove{}).turn_rad);
        said.front_source = "set manually";
    }
    if (change->large) said.size = *change->large ? 2 : 1;
    said.move = change->move.value_or(ObjectMove{});
    return said;
}

void drawRole(const Object& object, const Said& said, const json& key, EditRequest& edit) {
    formLabel("Target", "Targets should be captured; other objects are obstacles and labels only.");
    bool target = said.role == Role::Target;
    if (ImGui::Checkbox("##target", &target)) {
        edit.operation = {{"op", target ? "include" : "exclude"}, {"object", key}};
    }
    nameItem("selection.target");
    ImGui::SameLine();
    const char* note = said.role == Role::Excluded ? "excluded manually"
                       : object.structure          ? "part of the building"
                                                   : "";
    ImGui::TextColored(palette().text_dim, "%s", note);
}

void drawSize(const Object& object, const Said& said, const json& key, EditRequest& edit) {
    constexpr std::array kSizes = {"auto", "small", "large"};
    formLabel("Counts as", "Small objects are captured together with their supporting surface.");
    const std::string now = said.size != 0 ? kSizes[said.size]
                            : object.large ? "auto (large)"
                                           : "auto (small)";
    if (ImGui::BeginCombo("##size", now.c_str())) {
        for (int i = 0; i < 3; ++i) {
            const char* size = kSizes[i];
            if (ImGui::Selectable(size, said.size == i) && said.size != i) {
                edit.operation = {{"op", "set_size"}, {"object", key}, {"size", size}};
            }
            nameItem("selection.size." + std::string(size));
        }
        ImGui::EndCombo();
    }
    nameItem("selection.size");
}

void drawFront(const Said& said, const json& key, EditRequest& edit) {
    formLabel("Front", "The side with its best view. 0\u00b0: along x, 90\u00b0: along y");
    double angle = std::atan2(said.front.y(), said.front.x()) * 180.0 / std::numbers::pi;
    const FieldEdit field = dragNumber(angle, {-360.0, 360.0, 1.0F, "%.0f", "\u00b0"},
                                       "selection.front", said.front_source);
    if (field.changed) {
        edit.operation = {{"op", "set_front"}, {"object", key}, {"front", wrapDegrees(angle)}};
        edit.merge_key = "front." + key.dump();
    }
    edit.ends_merge = edit.ends_merge || field.finished;
    formText("", said.front_source);
}

void drawMove(const Said& said, const json& key, EditRequest& edit) {
    const auto request = [&](const FieldEdit& field, const char* what, json value) {
        if (field.changed) {
            edit.operation = {{"op", "move_object"}, {"object", key}};
            edit.operation[what] = std::move(value);
            edit.merge_key = std::string("move.") + what + key.dump();
        }
        edit.ends_merge = edit.ends_merge || field.finished;
    };
    // The cross button restores the value from the scene file; disabled if it is unchanged.
    const auto reset = [&](const char* name, const char* tip, bool changed, const char* what,
                           json value) {
        ImGui::SameLine();
        if (iconButton(Icon::Close, name,
                       {tip, changed ? "" : "It is at its position in the scene file."})) {
            edit.operation = {{"op", "move_object"}, {"object", key}};
            edit.operation[what] = std::move(value);
        }
    };
    const float room = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x;
    formLabel("Moved", "Offset from its position in the scene file, m");
    Eigen::Vector3d offset = said.move.offset_m;
    const FieldEdit moved = dragPoint(offset, kPlaceRange, "selection.move", {}, room);
    request(moved, "offset", pointJson(offset));
    reset("selection.move.reset", "Back to its position in the file (Alt+G)",
          !said.move.offset_m.isZero(0.0), "offset", pointJson(Eigen::Vector3d::Zero()));
    formLabel("Turned", "About the vertical through its centre; positive is counter-clockwise");
    double turn = said.move.turn_rad * 180.0 / std::numbers::pi;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - room);
    const FieldEdit turned = dragNumber(turn, kAngleRange, "selection.turn");
    request(turned, "turn_deg", turn);
    reset("selection.turn.reset", "Back to its heading in the file (Alt+R)",
          said.move.turn_rad != 0.0, "turn_deg", 0.0);
}

void drawButtons(const SelectionView& view, const Object& object, const SelectionState& state,
                 SelectionActions& actions) {
    const json key = objectKey(*view.scene, object.id);
    const bool changed =
        view.edits != nullptr && findChange(*view.edits, *view.scene, object.id) != nullptr;
    if (button("Go to", "selection.frame", {.tip = "Bring it into the viewport"})) {
        actions.frame = true;
    }
    flowTo("Split into pieces");
    if (button("Split into pieces", "selection.split",
               {.why_not = whyNoSplit(view, state.split), .tip = splitText(view, state.split)})) {
        actions.edit.operation = splitOperation(key, state.split);
    }
    flowTo("Reset");
    if (button(
            "Reset", "selection.reset",
            {.why_not = changed ? "" : "It has no manual edits.", .tip = "As the scene has it"})) {
        actions.edit.operation = {{"op", "reset_object"}, {"object", key}};
    }
}

void drawProperties(const SelectionView& view, const Object& object, SelectionState& state,
                    SelectionActions& actions) {
    const json key = objectKey(*view.scene, object.id);
    const ObjectChange* change =
        view.edits == nullptr ? nullptr : findChange(*view.edits, *view.scene, object.id);
    const Said said = whatIsSaid(object, change);
    if (!beginForm("properties")) return;
    formLabel("Class");
    if (const auto chosen = classCombo(said.nyu40, state.class_filter, "selection.class")) {
        actions.edit.operation = {{"op", "set_class"}, {"object", key}, {"class", *chosen}};
    }
    if (object.dataset_class) {
        formLabel("In datasets",
                  "The class that the label file gives it, by its name and NYU40 class.");
        ImGui::TextUnformatted(
            fmt::format("{} ({})", object.dataset_class->name, object.dataset_class->id).c_str());
    }
    drawRole(object, said, key, actions.edit);
    drawSize(object, said, key, actions.edit);
    drawFront(said, key, actions.edit);
    drawMove(said, key, actions.edit);
    formText("Size", sizeText(2.0 * object.box.half_size));
    formText("Centre", placeText(object.box.center) + " m");
    formText("Triangles", fmt::format("{}", object.triangle_count));
    endForm();
}

/// A link to a frame, and how well the object is visible in it.
void drawView(const char* label, const ObjectView& seen, const std::string& name,
              SelectionActions& actions) {
    formLine(label);
    if (link(fmt::format("Frame {}", seen.frame), name, "Go to this frame")) {
        actions.go_to_frame = seen.frame;
    }
    formText("", fmt::format("{:.0f} % visible, box {:.1f} % of the image",
                             100.0 * seen.visible_fraction, 100.0 * seen.box_share));
}

/// Additional values from the ledger.
void drawRow(const LedgerRow& row) {
    if (row.loss) {
        std::string words(name(*row.loss));
        std::ranges::replace(words, '_', ' ');
        formText("Reason", words);
    }
    if (row.frame < 0) return;
    formText("Seen from", fmt::format("{:.2f} m, {:.1f} s into the path{}", row.distance_m,
                                      row.time_s, row.key_frame ? ", at a key frame" : ""));
    formText("Mask", fmt::format("{:.1f} % of the image", 100.0 * row.mask_share));
}

void drawCapture(const SelectionView& view, const Object& object, SelectionActions& actions) {
    if (view.plan == nullptr || !view.measured) {
        ImGui::TextDisabled(view.plan == nullptr ? "There is no plan." : "being counted \u2026");
        return;
    }
    const auto& captures = view.plan->captures;
    const auto found = std::ranges::find(captures, object.id, &ObjectCapture::object_id);
    if (found == captures.end()) {
        ImGui::TextDisabled("Not a target: it need not be captured.");
        return;
    }
    if (found->well_captured) {
        ImGui::TextColored(palette().good, "\u25cf well captured");
    } else if (found->captured) {
        ImGui::TextColored(palette().warning, "\u25d0 captured, but small in the image");
    } else {
        ImGui::TextColored(palette().bad, "\u25cb not captured");
    }
    const auto row = std::ranges::find(view.plan->ledger, object.id, &LedgerRow::object_id);
    const LedgerRow* known = row == view.plan->ledger.end() ? nullptr : &*row;
    if (known != nullptr && known->loss) {
        paragraph(known->reason);
        actions.remedy = drawRemedy(view.remedy);
    }
    if (!beginForm("capture")) return;
    if (found->best.frame >= 0) {
        drawView("Best frame", found->best, "selection.best_frame", actions);
    } else {
        formText("Best frame", "none shows half of it");
    }
    if (found->well_captured && found->best_well.frame != found->best.frame) {
        drawView("Best well", found->best_well, "selection.best_well_frame", actions);
    }
    if (known != nullptr) drawRow(*known);
    endForm();
}

/// The class of several objects, if they have the same; choosing one sets it for all.
void drawSharedClass(const SelectionView& view, const std::vector<int>& ids, SelectionState& state,
                     SelectionActions& actions) {
    const auto classOf = [&](int id) {
        const ObjectChange* change =
            view.edits == nullptr ? nullptr : findChange(*view.edits, *view.scene, id);
        return whatIsSaid(view.scene->object(id), change).nyu40;
    };
    const int first = classOf(ids.front());
    const bool same = std::ranges::all_of(ids, [&](int id) { return classOf(id) == first; });
    if (!beginForm("shared properties")) return;
    formLabel("Class", "The class of all selected objects");
    if (const auto chosen = classCombo(same ? std::optional(first) : std::nullopt,
                                       state.class_filter, "selection.class")) {
        actions.edit.operation = {
            {"op", "set_class"}, {"object", objectKeys(*view.scene, ids)}, {"class", *chosen}};
    }
    endForm();
}

}  // namespace

void drawObject(const SelectionView& view, int id, SelectionState& state,
                SelectionActions& actions) {
    const Object& object = view.scene->object(id);
    heading(objectName(*view.scene, id).c_str());
    ImGui::SameLine();
    ImGui::TextColored(palette().text_dim, "no. %d", id);
    drawButtons(view, object, state, actions);
    drawSplit(view, state);
    ImGui::Spacing();
    drawCapture(view, object, actions);
    heading("Properties");
    drawProperties(view, object, state, actions);
    drawTrack(view, id, actions);
    if (view.plan == nullptr || object.role != Role::Target) return;
    const int point = observationPointOf(*view.plan, id);
    if (point < 0) return;
    heading("Search for a view");
    ImGui::Checkbox("Show candidates", &state.show_candidates);
    nameItem("selection.show_candidates");
    tooltip("All candidates, coloured by verdict");
    drawSearch(view, point, actions);
}

void drawObjects(const SelectionView& view, SelectionState& state, SelectionActions& actions) {
    const std::vector<int>& ids = view.selection->objects;
    heading(fmt::format("{} objects", ids.size()).c_str());
    if (const auto clicked = objectLinks(*view.scene, ids, "selection.object", 24)) {
        actions.select = clicked;
    }
    ImGui::Spacing();
    if (button("Go to", "selection.frame")) actions.frame = true;
    drawSharedClass(view, ids, state, actions);
    heading("Join them");
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##name", "Its name", &state.merge_name);
    nameItem("selection.merge_name");
    const std::string why_not = state.merge_name.empty() ? "Give the new object a name first." : "";
    if (button("Merge into one", "selection.merge", {.why_not = why_not})) {
        actions.edit.operation = {
            {"op", "merge"}, {"objects", objectKeys(*view.scene, ids)}, {"name", state.merge_name}};
        state.merge_name.clear();
    }
    ImGui::SameLine();
    if (button("Group touching objects", "selection.group")) {
        actions.edit.operation = {{"op", "group"}, {"object", objectKeys(*view.scene, ids)}};
        if (!state.merge_name.empty()) actions.edit.operation["name"] = state.merge_name;
        state.merge_name.clear();
    }
    tooltip(
        "Merges each group of touching objects into one, such as the legs and seats of chairs; "
        "their names get numbers");
}

}  // namespace dollytrack::ui
