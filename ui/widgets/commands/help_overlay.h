#pragma once

#include "ui/widgets/commands/command_table.h"

#include <string>

namespace dollytrack::ui {

/// What the help remembers between frames. Set `open` to show it.
struct HelpState {
    bool open = false;
    bool shown = false;
    std::string filter;
};

/// All commands by group with their keys, and what the mouse does in the viewport.
void drawHelpOverlay(const CommandTable& commands, HelpState& state);

}  // namespace dollytrack::ui
