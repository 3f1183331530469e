#include "ui/widgets/message_box.h"

#include "ui/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>

namespace dollytrack::ui {
namespace {

/// Item-map name of a label: "message.dont_save" for "Don't save".
std::string itemName(const std::string& label) {
    std::string name = "message.";
    for (const char c : label) {
        if (c == ' ') name += '_';
        if (std::isalnum(static_cast<unsigned char>(c))) {
            name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
    }
    return name;
}

void drawTitle(const MessageBox& box) {
    const ImVec4 color = box.is_error ? palette().bad : palette().accent;
    ImGui::PushFont(fonts().bold);
    ImGui::TextColored(color, box.is_error ? "\u26a0" : "\u2139");
    ImGui::SameLine();
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(box.title.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
    ImGui::Spacing();
}

/// Long text scrolls, so that its end can be read.
void drawText(const MessageBox& box) {
    const float wrap = ImGui::GetContentRegionAvail().x;
    const float height = ImGui::CalcTextSize(box.text.c_str(), nullptr, false, wrap).y;
    const float most = ImGui::GetIO().DisplaySize.y * 0.6F;
    const bool scrolls = height > most;
    if (scrolls) ImGui::BeginChild("text", {0, most});
    paragraph(box.text);
    if (scrolls) ImGui::EndChild();
}

int drawButtons(const MessageBox& box, bool is_valid) {
    int pressed = -1;
    const ImGuiStyle& style = ImGui::GetStyle();
    float width = 0.0F;
    for (const std::string& label : box.buttons) {
        width +=
            std::max(scaled(80), ImGui::CalcTextSize(label.c_str()).x + 2 * style.FramePadding.x) +
            style.ItemSpacing.x;
    }
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, ImGui::GetContentRegionAvail().x +
                                                                     style.ItemSpacing.x - width));
    for (int i = 0; i < static_cast<int>(box.buttons.size()); ++i) {
        const std::string& label = box.buttons[i];
        const float wide =
            std::max(scaled(80), ImGui::CalcTextSize(label.c_str()).x + 2 * style.FramePadding.x);
        if (i > 0) ImGui::SameLine();
        if (button(label.c_str(), itemName(label),
                   {.why_not = i == 0 && !is_valid ? "The field above is not valid." : "",
                    .width = wide,
                    .primary = i == 0})) {
            pressed = i;
        }
    }
    return pressed;
}

int drawContent(const MessageBox& box) {
    drawTitle(box);
    drawText(box);
    const bool is_valid = !box.field || box.field();
    ImGui::Dummy({0, scaled(6)});
    int pressed = drawButtons(box, is_valid);
    const int last = static_cast<int>(box.buttons.size()) - 1;
    // Ignores keys in the first frame: the key that caused the message must not answer it.
    if (!ImGui::IsWindowAppearing()) {
        if (is_valid && (ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) ||
                         ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false))) {
            pressed = 0;
        }
        if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) {
            pressed = box.escape >= 0 ? std::min(box.escape, last) : last;
        }
    }
    return pressed;
}

}  // namespace

int drawMessageBox(const MessageBox& box) {
    constexpr const char* kId = "##message_box";
    if (!ImGui::IsPopupOpen(kId)) ImGui::OpenPopup(kId);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(scaled(460), screen.x - scaled(40));
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({width, 0});
    int pressed = -1;
    pushDialogStyle();
    const bool visible = ImGui::BeginPopupModal(
        kId, nullptr,
        ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
            ImGuiWindowFlags_NoSavedSettings);
    popDialogStyle();
    if (visible) {
        pressed = drawContent(box);
        if (pressed >= 0) ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
    }
    return pressed;
}

UnsavedAnswer askUnsaved(const std::string& question, const std::string& what_next) {
    const int pressed =
        drawMessageBox({false,
                        question,
                        "Your changes are lost if you do not save them " + what_next + ".",
                        {"Save", "Don't save", "Cancel"}});
    switch (pressed) {
        case 0:
            return UnsavedAnswer::Save;
        case 1:
            return UnsavedAnswer::Discard;
        case 2:
            return UnsavedAnswer::Cancel;
        default:
            return UnsavedAnswer::None;
    }
}

}  // namespace dollytrack::ui
