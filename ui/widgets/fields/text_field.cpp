#include "ui/widgets/fields/text_field.h"

#include "ui/widgets/item_map.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <utility>

namespace dollytrack::ui {
namespace {

/// The text being typed; only one field can have the keyboard.
struct Typing {
    std::string name;
    std::string text;
};
Typing typing;

}  // namespace

bool textField(std::string& text, const std::string& name) {
    const bool mine = typing.name == name;
    std::string shown = mine ? typing.text : text;
    ImGui::PushID(name.c_str());
    const bool entered = ImGui::InputText(
        "##text", &shown, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    ImGui::PopID();
    nameItem(name);
    if (ImGui::IsItemActive()) {
        typing = {name, shown};
        return false;
    }
    if (!entered && !mine) return false;
    typing = {};
    if (!entered && ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) return false;
    return std::exchange(text, shown) != shown;
}

}  // namespace dollytrack::ui
