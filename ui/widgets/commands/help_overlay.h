#pragma once

#include "ui/widgets/commands/command_table.h"

#include <string>

namespace dollytrack::ui {

/// State kept between window frames. Set `open` to show the help.
struct HelpState {
    bool open = false;
    bool shown = false;
    std::string filter;
};

/// Draws all commands by group with their shortcuts, and the mouse controls.
void drawHelpOverlay(const CommandTable& commands, HelpState& state);

}  // namespace dollytrack::ui
