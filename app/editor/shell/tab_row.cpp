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
    return shown;
}

bool TabRow::begin(const char* name, std::string& focus) {
    const bool focused = focus == name;
    if (focused) focus.clear();
    const bool restored = wanted_ == name;
    met_wanted_ |= restored;
    pushPadding();
    const bool shown =
        ImGui::BeginTabItem(name, nullptr, focused || restored ? ImGuiTabItemFlags_SetSelected : 0);
    ImGui::PopStyleVar();
    // A requested tab is selected in the next frame; until then another one is.
    if (focused || restored) {
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
    if (!std::exchange(met_wanted_, false)) wanted_.clear();
}

}  // namespace dollytrack::editor
