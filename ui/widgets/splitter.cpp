#include "ui/widgets/splitter.h"

#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <algorithm>

namespace dollytrack::ui {

bool splitter(const char* name, ImVec2 low, ImVec2 high, bool vertical, float sign, float& length,
              float least, float most) {
    // A separate window, so that it can be grabbed over its neighbours' borders.
    ImGui::SetNextWindowPos(low);
    ImGui::SetNextWindowSize({high.x - low.x, high.y - low.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground);
    ImGui::PopStyleVar(2);
    ImGui::InvisibleButton("grip", {high.x - low.x, high.y - low.y});
    nameItem(name);
    const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (hot) {
        ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    }
    const ImU32 color = ImGui::GetColorU32(hot ? palette().accent : palette().panel_line);
    const ImVec2 middle(0.5F * (low.x + high.x), 0.5F * (low.y + high.y));
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (vertical) {
        list->AddLine({middle.x, low.y}, {middle.x, high.y}, color);
    } else {
        list->AddLine({low.x, middle.y}, {high.x, middle.y}, color);
    }
    bool changed = false;
    if (ImGui::IsItemActive()) {
        const ImVec2 delta = ImGui::GetIO().MouseDelta;
        const float wanted =
            std::clamp(length + sign * (vertical ? delta.x : delta.y), least, most);
        changed = wanted != length;
        length = wanted;
    }
    ImGui::End();
    return changed;
}

}  // namespace dollytrack::ui
