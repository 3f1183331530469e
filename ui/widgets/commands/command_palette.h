#pragma once

#include "engine/scene/scene.h"
#include "ui/widgets/commands/command_table.h"
#include "ui/widgets/fuzzy_match.h"

#include <string>
#include <vector>

namespace dollytrack::ui {

/// A searchable entry besides commands: a parameter.
struct PaletteItem {
    std::string name;  // "fill"
    std::string text;  // description: "Share of the image's width or height that the target takes"
};

struct CommandPaletteView {
    const CommandTable* commands = nullptr;
    const std::vector<PaletteItem>* parameters = nullptr;
    const Scene* scene = nullptr;  // null: no scene is open
};

/// State kept between window frames. Set `open` to show the palette.
struct CommandPaletteState {
    struct Hit {
        enum class Kind { Command, Parameter, Object };
        Kind kind = Kind::Command;
        std::size_t index = 0;  // index in the view's list
        FuzzyMatch match;
    };
    bool open = false;
    std::string text;
    int selected = 0;
    std::vector<Hit> hits;  // results for the text `found_for`
    std::string found_for;
    bool found = false;
};

/// The chosen entry; empty and 0: none.
struct CommandPaletteActions {
    std::string run;              // id of a runnable command
    std::string focus_parameter;  // name
    int select_object = 0;        // id
};

/// Draws a search line that finds commands, parameters and objects by fuzzy matching of their
/// names.
CommandPaletteActions drawCommandPalette(const CommandPaletteView& view,
                                         CommandPaletteState& state);

/// The entries for a text, best match first, at most 200. For an empty text, all commands in their
/// order.
std::vector<CommandPaletteState::Hit> findInPalette(const CommandPaletteView& view,
                                                    const std::string& text);

}  // namespace dollytrack::ui
