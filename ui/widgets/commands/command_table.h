#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::ui {

/// Key combination of a command: a GLFW key code (0: none) with modifiers.
struct Shortcut {
    int key = 0;
    bool ctrl = false;
    bool shift = false;
    bool alt = false;
    [[nodiscard]] std::string text() const;  // "Ctrl+Shift+S"; empty if there is none
};

/// A user command. Menus, shortcuts, the palette and the help are generated from the table of
/// commands.
struct Command {
    std::string id;     // "file.open"
    std::string group;  // menu name: "File"
    std::string title;  // "Open…"
    Shortcut shortcut;
    std::function<void()> run;
    std::function<std::string()> why_not = {};  // returns why the command cannot run; empty: it can
    std::function<bool()> checked = {};         // for on/off commands: whether it is on
    Shortcut other_shortcut = {};               // does the same
    // Title of a menu within that of the group; its commands are adjacent.
    std::string submenu = {};

    [[nodiscard]] std::string keys() const;  // "Ctrl+Shift+Z, Ctrl+Y"
    [[nodiscard]] bool canRun() const { return !why_not || why_not().empty(); }
};

class CommandTable {
  public:
    void add(Command command) { commands_.push_back(std::move(command)); }
    [[nodiscard]] const std::vector<Command>& all() const { return commands_; }
    [[nodiscard]] const Command* find(std::string_view id) const;

    /// Returns the character that a GLFW key produces on the user's keyboard layout, such as "+";
    /// empty: unknown or not a single character.
    using KeySigns = std::function<std::string(int key)>;

    /// Runs the command whose shortcut was pressed this frame. While a text field has the keyboard,
    /// only shortcuts that text editing does not use are active. Returns why the command cannot
    /// run, empty if it ran; unset if no shortcut was pressed.
    std::optional<std::string> runShortcuts(const KeySigns& signs = {}) const;

    /// Draws the menu items of a group, with its submenus.
    void drawMenuItems(std::string_view group) const;
    /// Draws the menu item of a command; does nothing for an unknown id.
    void drawMenuItem(std::string_view id) const;

  private:
    std::vector<Command> commands_;
};

}  // namespace dollytrack::ui
