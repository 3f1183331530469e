#include "ui/widgets/note_bar.h"

#include "ui/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

#include <algorithm>

namespace dollytrack::ui {

int drawNoteBar(const std::string& name, const std::string& text,
                const std::vector<NoteBarButton>& buttons, NoteBarKind kind) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float padding = scaled(10);
    const float border = scaled(4);
    float width = 0.0F;  // of the buttons
    for (const NoteBarButton& one : buttons) {
        width += ImGui::CalcTextSize(one.label.c_str()).x + 2 * style.FramePadding.x +
                 style.ItemSpacing.x;
    }
    const float bar = ImGui::GetContentRegionAvail().x;
    const float text_width = std::max(bar - width - 2 * padding, scaled(60));
    const float text_height =
        ImGui::CalcTextSize(text.c_str(), nullptr, false, text_width).y + 2 * style.FramePadding.y;
    const ImVec2 size(bar, std::max(text_height, ImGui::GetFrameHeight()) + 2 * border);
    int pressed = -1;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {padding, border});
    ImGui::BeginChild(name.c_str(), size, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar |
                          ImGuiWindowFlags_NoNav);
    nameArea(name, low.x, low.y, low.x + size.x, low.y + size.y);
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, kind == NoteBarKind::Warning
                                             ? palette().warning
                                             : ImGui::GetStyleColorVec4(ImGuiCol_Text));
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + text_width);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::SetCursorScreenPos({low.x + padding + text_width, low.y + border});
    for (std::size_t i = 0; i < buttons.size(); ++i) {
        if (i > 0) ImGui::SameLine();
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
