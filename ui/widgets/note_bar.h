#pragma once

#include <string>
#include <vector>

namespace dollytrack::ui {

struct NoteBarButton {
    std::string label;
    std::string tip;
};

enum class NoteBarKind { Warning, Confirmation };

/// A notification bar across the current window that does not block. Returns the index of the
/// pressed button, or -1. In the item map the bar is called `name`, and its buttons `name`.0, .1 ….
int drawNoteBar(const std::string& name, const std::string& text,
                const std::vector<NoteBarButton>& buttons, NoteBarKind kind = NoteBarKind::Warning);

}  // namespace dollytrack::ui
