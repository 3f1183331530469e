#include "app/editor/shell/tab_row.h"

#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace dollytrack::editor {

namespace {

/// Little padding, so that narrow panels show the names of their tabs in full.
void pushPadding() {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                        {ui::scaled(4), ImGui::GetStyle().FramePadding.y});
}

}  // namespace

bool TabRow::beginRow(const char* id) {
    pushPadding();
    const bool shown = ImGui::BeginTabBar(id);
    ImGui::PopStyleVar();
    wanted_before_ = wanted_;
    return shown;
}

bool TabRow::begin(const char* name, unsigned badge) {
    const bool wanted = wanted_ == name;
    met_wanted_ |= wanted;
    // The tab's identity does not depend on its badge.
    std::string label = name;
    if (badge > 0) label += " (" + std::to_string(badge) + ")";
    label += "###" + std::string(name);
    pushPadding();
    if (badge > 0) ImGui::PushStyleColor(ImGuiCol_Text, ui::palette().warning);
    const bool shown =
        ImGui::BeginTabItem(label.c_str(), nullptr, wanted ? ImGuiTabItemFlags_SetSelected : 0);
    if (badge > 0) ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    // A requested tab is selected in the next frame; until then another one is.
    if (wanted) {
        wanted_ = shown ? "" : name;
        open_ = name;
    } else if (shown && wanted_.empty()) {
        open_ = name;
    }
    std::string item = "tab." + std::string(name);
    std::ranges::transform(item, item.begin(), [](unsigned char c) { return std::tolower(c); });
    ui::nameItem(item);
    return shown;
}

void TabRow::end() {
    // A tab that was selected while the row was drawn is met in the next frame.
    if (!std::exchange(met_wanted_, false) && wanted_ == wanted_before_) wanted_.clear();
}

}  // namespace dollytrack::editor
