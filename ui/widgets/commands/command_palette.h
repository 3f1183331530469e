#pragma once

#include "engine/scene/scene.h"
#include "ui/widgets/commands/command_table.h"
#include "ui/widgets/commands/fuzzy_match.h"

#include <string>
#include <vector>

namespace dollytrack::ui {

/// Something else than a command that can be found by its name.
struct PaletteItem {
    std::string name;  // "fill"
    std::string text;  // "Share of the image's length that the target takes"
};

struct CommandPaletteView {
    const CommandTable* commands = nullptr;
    const std::vector<PaletteItem>* parameters = nullptr;
    const Scene* scene = nullptr;  // null: none is open
};

/// What the palette remembers between frames. Set `open` to show it.
struct CommandPaletteState {
    struct Hit {
        enum class Kind { Command, Parameter, Object };
        Kind kind = Kind::Command;
        std::size_t index = 0;  // in the view's list
        FuzzyMatch match;
    };
    bool open = false;
    std::string text;
    int selected = 0;
    std::vector<Hit> hits;  // for `found_for`
    std::string found_for;
    bool found = false;
};

/// What was chosen; empty and 0: nothing.
struct CommandPaletteActions {
    std::string run;              // id of a command that can run
    std::string focus_parameter;  // name
    int select_object = 0;        // id
};

/// One line to type into that finds commands, parameters and objects by parts of their names.
CommandPaletteActions drawCommandPalette(const CommandPaletteView& view,
                                         CommandPaletteState& state);

/// What the palette lists for a text, best first; commands in their order when it is empty.
std::vector<CommandPaletteState::Hit> findInPalette(const CommandPaletteView& view,
                                                    const std::string& text);

}  // namespace dollytrack::ui
