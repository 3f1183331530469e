#include "ui/panels/scene/objects_panel.h"

#include "engine/scene/labels.h"
#include "engine/scene/scene_report.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/fields/choice_combo.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"
#include "ui/widgets/text_match.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace dollytrack::ui {
namespace {

constexpr std::array<const char*, 6> kShown = {
    "All", "Targets", "Not captured", "Captured small", "Well captured", "Not targets"};

const ObjectCapture* captureOf(const ObjectsView& view, int id) {
    if (view.captures == nullptr) return nullptr;
    const auto at = std::ranges::lower_bound(*view.captures, id, {}, &ObjectCapture::object_id);
    return at != view.captures->end() && at->object_id == id ? &*at : nullptr;
}

bool isShown(const ObjectsView& view, const ObjectsPanelState& state, const Object& object) {
    const ObjectCapture* capture = captureOf(view, object.id);
    const bool captured = capture != nullptr && capture->captured;
    const bool well = capture != nullptr && capture->well_captured;
    const bool target = object.role == Role::Target;
    switch (state.shown) {
        case 1:
            // Excluded objects stay in the list, so that they can be made targets again.
            if (object.role == Role::Structure) return false;
            break;
        case 2:
            if (!target || captured) return false;
            break;
        case 3:
            if (!captured || well) return false;
            break;
        case 4:
            if (!well) return false;
            break;
        case 5:
            if (target) return false;
            break;
        default:
            break;
    }
    return state.filter.empty() || containsIgnoringCase(object.name, state.filter) ||
           containsIgnoringCase(nyu40Name(object.nyu40), state.filter) ||
           (object.dataset_class && containsIgnoringCase(object.dataset_class->name, state.filter));
}

void drawState(const Object& object, const ObjectCapture* capture) {
    const char* text = "–";
    ImVec4 color = palette().text_dim;
    std::string why = object.role == Role::Structure ? "Part of the building: obstacle and label"
                                                     : "Excluded: obstacle and label only";
    if (object.role == Role::Target) {
        text = "…";
        why = "Not planned yet";
        if (capture != nullptr && capture->well_captured) {
            text = "●";
            color = palette().good;
            why = "Well captured: at least 80 % visible, and its box takes 5 % of the image";
        } else if (capture != nullptr && capture->captured) {
            text = "◐";
            color = palette().warning;
            why = "Captured, but small in the image";
        } else if (capture != nullptr) {
            text = "○";
            color = palette().bad;
            why = "Not captured; select it to see why";
        }
    }
    ImGui::TextColored(color, "%s", text);
    tooltipBeside(why);
}

/// Scrolls the row into view by the smallest amount, or centres it if it is entirely outside: the
/// list must not jump under the mouse that clicked the row.
void bringRowIntoView() {
    const float top = ImGui::GetWindowPos().y + ImGui::GetFrameHeight();  // below the header row
    const float bottom = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
    const float low = ImGui::GetItemRectMin().y;
    const float high = ImGui::GetItemRectMax().y;
    if (high < top || low > bottom) return ImGui::SetScrollHereY(0.5F);
    if (low < top) ImGui::SetScrollY(ImGui::GetScrollY() - (top - low));
    if (high > bottom) ImGui::SetScrollY(ImGui::GetScrollY() + (high - bottom));
}

std::string listName(const Object& object) {
    return object.name.empty() ? "object " + std::to_string(object.id) : object.name;
}

/// The names of all rows as the column shows them, so that scrolling does not change them.
const std::vector<std::string>& shownNames(const std::vector<const Object*>& rows,
                                           ObjectsPanelState& state) {
    std::vector<std::string> whole;
    for (const Object* object : rows) whole.push_back(listName(*object));
    ObjectsPanelState::ShownNames& names = state.names;
    if (names.whole != whole || names.width != state.name_width) {
        names.cut = cutApart(whole, state.name_width);
        names.whole = std::move(whole);
        names.width = state.name_width;
    }
    return names.cut;
}

void drawRow(const ObjectsView& view, ObjectsPanelState& state, const Object& object,
             const std::string& shown_name, bool with_class, ObjectsActions& actions) {
    ImGui::PushID(object.id);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    drawState(object, captureOf(view, object.id));
    ImGui::TableNextColumn();
    const bool selected = view.selected != nullptr &&
                          std::ranges::find(*view.selected, object.id) != view.selected->end();
    const std::string name = listName(object);
    state.name_width = ImGui::GetContentRegionAvail().x;
    // The pushed id distinguishes names that are cut to the same text.
    if (ImGui::Selectable(shown_name.c_str(), selected,
                          ImGuiSelectableFlags_SpanAllColumns |
                              ImGuiSelectableFlags_AllowItemOverlap |
                              ImGuiSelectableFlags_AllowDoubleClick)) {
        actions.clicked = object.id;
        actions.add_to_selection = state.pressed_with_ctrl;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) actions.frame = object.id;
    }
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) actions.right_clicked = object.id;
    if (ImGui::IsItemClicked()) {
        state.pressed_with_ctrl = io.KeyCtrl;
        state.pressed_with_shift = io.KeyShift;
    }
    nameItem("objects.row." + std::to_string(object.id));
    const std::string class_name = className(object);
    if (shown_name != name || !with_class) tooltipBeside(name + "\n" + class_name);
    if (state.scroll_to == object.id) {
        bringRowIntoView();
        state.scroll_to = 0;
    }
    if (with_class) {
        ImGui::TableNextColumn();
        cutText(class_name, palette().text_dim);
    }
    ImGui::TableNextColumn();
    ImGui::TextColored(palette().text_dim, "%s", object.large ? "L" : "s");
    tooltipBeside(object.large ? "large" : "small");
    ImGui::TableNextColumn();
    const bool hidden = view.hidden != nullptr &&
                        static_cast<std::size_t>(object.id) < view.hidden->size() &&
                        (*view.hidden)[object.id];
    if (ImGui::SmallButton(hidden ? "◌##eye" : "◉##eye")) actions.toggle_hidden = object.id;
    nameItem("objects.eye." + std::to_string(object.id));
    tooltipBeside(hidden ? "Hidden in the viewport; click to show"
                         : "Click to hide in the viewport; the plan does not change");
    ImGui::TableNextColumn();
    if (object.role != Role::Structure) {
        const ObjectChange* change =
            view.edits != nullptr ? findChange(*view.edits, *view.scene, object.id) : nullptr;
        // Shows the newest edit: a second click before the next plan reverts the first.
        bool target =
            (change != nullptr ? change->role.value_or(object.role) : object.role) == Role::Target;
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {scaled(2), 0});
        if (ImGui::Checkbox("##target", &target)) {
            actions.toggle_target = object.id;
            actions.make_target = target;
        }
        ImGui::PopStyleVar();
        nameItem("objects.target." + std::to_string(object.id));
        tooltipBeside("Whether it is a target: the plan should capture it");
    }
    ImGui::PopID();
}

/// The ids of the rows from one object to another, in this order; only the second if the first has
/// no row.
std::vector<int> rowsBetween(const std::vector<const Object*>& rows, int from, int to) {
    const auto first = std::ranges::find(rows, from, &Object::id);
    const auto last = std::ranges::find(rows, to, &Object::id);
    if (first == rows.end() || last == rows.end()) return {to};
    std::vector<int> ids;
    for (auto row = std::min(first, last); row <= std::max(first, last); ++row) {
        ids.push_back((*row)->id);
    }
    if (last < first) std::ranges::reverse(ids);
    return ids;
}

}  // namespace

ObjectsActions drawObjectsPanel(const ObjectsView& view, ObjectsPanelState& state) {
    ObjectsActions actions;
    if (view.scene == nullptr) {
        ImGui::TextDisabled("No scene is open.");
        return actions;
    }
    ImGui::SetNextItemWidth(-scaled(132));
    ImGui::InputTextWithHint("##filter", "Find an object", &state.filter);
    nameItem("objects.filter");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    choiceCombo("objects.shown", state.shown, kShown);
    std::vector<const Object*> rows;
    for (const Object& object : view.scene->objects) {
        if (isShown(view, state, object)) rows.push_back(&object);
    }
    ImGui::TextDisabled("%zu of %zu objects", rows.size(), view.scene->objects.size());
    // Names take precedence: without room for both, the class moves to the tooltip.
    const bool with_class = ImGui::GetContentRegionAvail().x > scaled(330);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {scaled(3), ImGui::GetStyle().CellPadding.y});
    const bool begun = ImGui::BeginTable(
        with_class ? "objects" : "objects without class", with_class ? 6 : 5,
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit);
    ImGui::PopStyleVar();
    if (!begun) return actions;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("");
    ImGui::TableSetupColumn("Object", ImGuiTableColumnFlags_WidthStretch, 1.3F);
    if (with_class) ImGui::TableSetupColumn("Class", ImGuiTableColumnFlags_WidthStretch, 0.7F);
    ImGui::TableSetupColumn("");
    ImGui::TableSetupColumn("");
    ImGui::TableSetupColumn("Target");
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper;
    const auto scroll_row = std::ranges::find_if(
        rows, [&](const Object* object) { return object->id == state.scroll_to; });
    const std::vector<std::string>& names = shownNames(rows, state);
    clipper.Begin(static_cast<int>(rows.size()));
    if (scroll_row != rows.end()) {
        const int at = static_cast<int>(scroll_row - rows.begin());
        clipper.ForceDisplayRangeByIndices(at, at + 1);
    }
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            drawRow(view, state, *rows[i], names[i], with_class, actions);
        }
    }
    ImGui::EndTable();
    if (actions.clicked != 0 && state.pressed_with_shift) {
        actions.range = rowsBetween(rows, state.anchor, actions.clicked);
    } else if (actions.clicked != 0) {
        state.anchor = actions.clicked;
    }
    return actions;
}

}  // namespace dollytrack::ui
