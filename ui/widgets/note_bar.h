#pragma once

#include <string>
#include <vector>

namespace dollytrack::ui {

struct NoteBarButton {
    std::string label;
    std::string tip;
};

/// A line over the whole width of the window at hand that says something without waiting for an
/// answer. Returns the button that was pressed, or -1. `name` is its name in the item map, and
/// `name`.0, .1 … those of its buttons.
int drawNoteBar(const std::string& name, const std::string& text,
                const std::vector<NoteBarButton>& buttons);

}  // namespace dollytrack::ui
