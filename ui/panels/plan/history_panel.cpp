#include "ui/panels/plan/history_panel.h"

#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

namespace dollytrack::ui {

HistoryActions drawHistoryPanel(const HistoryView& view, HistoryState& state) {
    HistoryActions actions;
    if (view.names == nullptr || view.names->empty()) {
        ImGui::TextDisabled("No project is open.");
        return actions;
    }
    ImGui::BeginChild("history");
    const bool moved =
        state.shown_position != view.position || state.shown_count != view.names->size();
    state.shown_position = view.position;
    state.shown_count = view.names->size();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(view.names->size()));
    if (moved) {
        const int at = static_cast<int>(view.position);
        clipper.ForceDisplayRangeByIndices(at, at + 1);
    }
    while (clipper.Step()) {
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
            const std::size_t i = row;
            const bool undone = i > view.position;
            ImGui::PushID(row);
            ImGui::TextColored(i == view.position ? palette().accent : palette().text_dim, "%s",
                               i == view.position ? "\u25b8" : " ");
            ImGui::SameLine(scaled(16));
            if (undone) ImGui::PushStyleColor(ImGuiCol_Text, palette().text_dim);
            const std::string& name = (*view.names)[i];
            const float room = ImGui::GetContentRegionAvail().x;
            if (ImGui::Selectable(cutToWidth(name, room).c_str(), i == view.position) &&
                i != view.position) {
                actions.go_to = i;
            }
            if (undone) ImGui::PopStyleColor();
            nameItem("history.step." + std::to_string(row));
            wholeText(name, room,
                      i == view.position ? ""
                      : undone           ? "Redo up to here"
                                         : "Undo back to here");
            if (moved && i == view.position) ImGui::SetScrollHereY(0.7F);
            ImGui::PopID();
        }
    }
    ImGui::EndChild();
    return actions;
}

}  // namespace dollytrack::ui
