#include "app/editor/shell/panel_navigation.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_internal.h>

namespace dollytrack::editor {

void PanelNavigation::beginFrame() {
    ImGuiIO& io = ImGui::GetIO();
    // Without a key, ImGui does not move the focus to the next text field.
    io.KeyMap[ImGuiKey_Tab] = keys_taken_ ? -1 : GLFW_KEY_TAB;
    if (io.KeysDown[GLFW_KEY_TAB] && !io.KeyAlt && !keys_taken_) by_keys_ = true;
    if (io.KeysDown[GLFW_KEY_ESCAPE] && !io.WantTextInput) by_keys_ = false;
    constexpr ImGuiPopupFlags kAny = ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel;
    const bool on = (by_keys_ && !keys_taken_) || dialog_open_ || ImGui::IsPopupOpen("", kAny);
    if (on) {
        io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    } else {
        io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
        // Otherwise the frame around the focused widget would stay.
        ImGui::GetCurrentContext()->NavDisableHighlight = true;
    }
}

void PanelNavigation::endFrame(bool mouse_over_viewport, bool dialog_open, bool keys_taken) {
    const ImGuiIO& io = ImGui::GetIO();
    dialog_open_ = dialog_open;
    keys_taken_ = keys_taken;
    const bool moved = io.MouseDelta.x != 0.0F || io.MouseDelta.y != 0.0F;
    bool clicked = false;
    for (const bool button : io.MouseClicked) clicked = clicked || button;
    if (clicked || (moved && mouse_over_viewport)) by_keys_ = false;
}

}  // namespace dollytrack::editor
