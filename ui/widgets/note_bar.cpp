#include "ui/widgets/note_bar.h"

#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

#include <algorithm>

namespace dollytrack::ui {

int drawNoteBar(const std::string& name, const std::string& text,
                const std::vector<NoteBarButton>& buttons) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight() + scaled(8));
    int pressed = -1;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(10), scaled(4)});
    ImGui::BeginChild(name.c_str(), size, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar |
                          ImGuiWindowFlags_NoNav);
    nameArea(name, low.x, low.y, low.x + size.x, low.y + size.y);
    float width = 0.0F;
    for (const NoteBarButton& one : buttons) {
        width += ImGui::CalcTextSize(one.label.c_str()).x + 2 * style.FramePadding.x +
                 style.ItemSpacing.x;
    }
    ImGui::AlignTextToFramePadding();
    cutText(text, palette().warning, {}, Cut::End,
            std::max(ImGui::GetContentRegionAvail().x - width, scaled(60)));
    for (std::size_t i = 0; i < buttons.size(); ++i) {
        ImGui::SameLine();
        if (button(buttons[i].label.c_str(), name + "." + std::to_string(i),
                   {.tip = buttons[i].tip})) {
            pressed = static_cast<int>(i);
        }
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    // The next widget follows directly, without ImGui's spacing.
    ImGui::SetCursorScreenPos({low.x, low.y + size.y});
    return pressed;
}

}  // namespace dollytrack::ui
