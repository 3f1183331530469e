#include "ui/widgets/commands/command_table.h"

#include "ui/widgets/item_map.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>

namespace dollytrack::ui {
namespace {

std::string keyName(int key) {
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25)
        return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) {
        return "Num " + std::to_string(key - GLFW_KEY_KP_0);
    }
    switch (key) {
        case GLFW_KEY_KP_DECIMAL:
            return "Num .";
        case GLFW_KEY_EQUAL:
            return "+";
        case GLFW_KEY_PAGE_UP:
            return "Page up";
        case GLFW_KEY_PAGE_DOWN:
            return "Page down";
        case GLFW_KEY_SPACE:
            return "Space";
        case GLFW_KEY_HOME:
            return "Home";
        case GLFW_KEY_END:
            return "End";
        case GLFW_KEY_LEFT:
            return "Left";
        case GLFW_KEY_RIGHT:
            return "Right";
        case GLFW_KEY_UP:
            return "Up";
        case GLFW_KEY_DOWN:
            return "Down";
        case GLFW_KEY_DELETE:
            return "Delete";
        case GLFW_KEY_ESCAPE:
            return "Esc";
        case GLFW_KEY_ENTER:
            return "Enter";
        case GLFW_KEY_PERIOD:
            return ".";
        case GLFW_KEY_COMMA:
            return ",";
        default:
            return key > 32 && key < 127 ? std::string(1, static_cast<char>(key)) : "?";
    }
}

/// Zoom shortcuts also accept + and - on the number pad, and whichever key produces that character
/// on the user's layout.
bool pressedElsewhere(int key, const CommandTable::KeySigns& signs) {
    if (key != GLFW_KEY_EQUAL && key != GLFW_KEY_MINUS) return false;
    const bool larger = key == GLFW_KEY_EQUAL;
    if (ImGui::IsKeyPressed(larger ? GLFW_KEY_KP_ADD : GLFW_KEY_KP_SUBTRACT, false)) return true;
    if (!signs) return false;
    for (int other = GLFW_KEY_APOSTROPHE; other <= GLFW_KEY_GRAVE_ACCENT; ++other) {
        if (other == GLFW_KEY_EQUAL || other == GLFW_KEY_MINUS) continue;
        if (ImGui::IsKeyPressed(other, false) && signs(other) == (larger ? "+" : "-")) return true;
    }
    return false;
}

/// Whether a key moves between widgets, or presses one, while the user does so with the keyboard.
bool movesFocus(int key) {
    constexpr std::array kKeys = {
        GLFW_KEY_SPACE, GLFW_KEY_ENTER, GLFW_KEY_LEFT, GLFW_KEY_RIGHT,   GLFW_KEY_UP,
        GLFW_KEY_DOWN,  GLFW_KEY_HOME,  GLFW_KEY_END,  GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN};
    return std::ranges::find(kKeys, key) != kKeys.end();
}

/// Whether the keys were pressed this frame and no text field or focused widget uses them itself.
bool isPressed(const Shortcut& keys, const CommandTable::KeySigns& signs) {
    const ImGuiIO& io = ImGui::GetIO();
    // Only stepping, orbiting and undo shortcuts repeat while a key is held.
    constexpr std::array kRepeating = {GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_Z,    GLFW_KEY_Y,
                                       GLFW_KEY_KP_2, GLFW_KEY_KP_4,  GLFW_KEY_KP_6, GLFW_KEY_KP_8};
    const bool repeats = std::ranges::find(kRepeating, keys.key) != kRepeating.end();
    if (keys.key == 0) return false;
    if (keys.ctrl != io.KeyCtrl || keys.alt != io.KeyAlt) return false;
    const bool pressed = ImGui::IsKeyPressed(keys.key, repeats);
    if (!pressed && !(keys.ctrl && pressedElsewhere(keys.key, signs))) return false;
    if (io.NavVisible && !keys.ctrl && movesFocus(keys.key)) return false;
    // On many keyboards + needs Shift.
    if (keys.shift != io.KeyShift && keys.key != GLFW_KEY_EQUAL) return false;
    // While a text field has the keyboard, keys it uses itself are not shortcuts.
    const bool edits_text = keys.ctrl && (keys.key == GLFW_KEY_Z || keys.key == GLFW_KEY_Y ||
                                          keys.key == GLFW_KEY_HOME || keys.key == GLFW_KEY_END ||
                                          keys.key == GLFW_KEY_LEFT || keys.key == GLFW_KEY_RIGHT);
    const bool types = keys.key < GLFW_KEY_F1 || keys.key >= GLFW_KEY_KP_0;
    return !(io.WantTextInput && (edits_text || (!keys.ctrl && types)));
}

}  // namespace

std::string Shortcut::text() const {
    std::string text;
    if (key == 0) return text;
    if (ctrl) text += "Ctrl+";
    if (shift) text += "Shift+";
    if (alt) text += "Alt+";
    text += keyName(key);
    return text;
}

std::string Command::keys() const {
    const std::string other = other_shortcut.text();
    return other.empty() ? shortcut.text() : shortcut.text() + ", " + other;
}

const Command* CommandTable::find(std::string_view id) const {
    const auto at = std::ranges::find(commands_, id, &Command::id);
    return at == commands_.end() ? nullptr : &*at;
}

std::optional<std::string> CommandTable::runShortcuts(const KeySigns& signs) const {
    std::optional<std::string> refused;
    for (const Command& command : commands_) {
        if (!isPressed(command.shortcut, signs) && !isPressed(command.other_shortcut, signs)) {
            continue;
        }
        std::string why_not = command.why_not ? command.why_not() : std::string();
        if (!why_not.empty()) {
            if (!refused) refused = std::move(why_not);
            continue;
        }
        command.run();
        return std::string();
    }
    return refused;
}

void CommandTable::drawMenuItems(std::string_view group) const {
    std::string last;   // submenu of the last command; empty: none
    bool open = false;  // whether that is drawn
    const auto end = [&] {
        if (open) ImGui::EndMenu();
        open = false;
        if (!last.empty()) nameItem("menu." + last);
    };
    for (const Command& command : commands_) {
        if (command.group != group) continue;
        if (command.submenu != last) {
            end();
            last = command.submenu;
            open = !last.empty() && ImGui::BeginMenu(last.c_str());
        }
        if (last.empty() || open) drawMenuItem(command.id);
    }
    end();
}

void CommandTable::drawMenuItem(std::string_view id) const {
    const Command* command = find(id);
    if (command == nullptr) return;
    const std::string why_not = command->why_not ? command->why_not() : std::string();
    const bool checked = command->checked && command->checked();
    if (ImGui::MenuItem(command->title.c_str(), command->keys().c_str(), checked,
                        why_not.empty())) {
        command->run();
    }
    nameItem("command." + command->id, why_not.empty());
    if (!why_not.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        ImGui::SetTooltip("%s", why_not.c_str());
    }
}

}  // namespace dollytrack::ui
