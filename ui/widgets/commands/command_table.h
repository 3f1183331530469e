#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::ui {

/// Keys that run a command: a GLFW key code (0: none) with modifiers.
struct Shortcut {
    int key = 0;
    bool ctrl = false;
    bool shift = false;
    bool alt = false;
    [[nodiscard]] std::string text() const;  // "Ctrl+Shift+S"; empty when there is none
};

/// Something the user can have done: menus, shortcuts, the palette and the help are all made from
/// the one list of these.
struct Command {
    std::string id;     // "file.open"
    std::string group;  // "File": the menu it is in
    std::string title;  // "Open…"
    Shortcut shortcut;
    std::function<void()> run;
    std::function<std::string()> why_not = {};  // empty text: it can run; else the reason it cannot
    std::function<bool()> checked = {};         // for switches

    [[nodiscard]] bool canRun() const { return !why_not || why_not().empty(); }
};

class CommandTable {
  public:
    void add(Command command) { commands_.push_back(std::move(command)); }
    [[nodiscard]] const std::vector<Command>& all() const { return commands_; }
    [[nodiscard]] const Command* find(std::string_view id) const;

    /// What a key writes on the user's keyboard, "+" say; empty: not one sign, or not known.
    using KeySigns = std::function<std::string(int key)>;

    /// Runs the command whose keys were pressed this frame, unless a text field has the keyboard.
    /// Returns its id; empty when there was none.
    std::string runShortcuts(const KeySigns& signs = {}) const;

    /// A menu's entry; separators are the caller's.
    void drawMenuItem(std::string_view id) const;

  private:
    std::vector<Command> commands_;
};

}  // namespace dollytrack::ui
