#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

struct HistoryView {
    const std::vector<std::string>* names = nullptr;  // CommandStack::names()
    std::size_t position = 0;                         // where we are in it
};

/// What the panel remembers between frames.
struct HistoryState {
    std::size_t shown_position = 0;  // scrolls only when the position has changed
    std::size_t shown_count = 0;
};

struct HistoryActions {
    std::optional<std::size_t> go_to;  // CommandStack::goTo()
};

/// The steps of undo and redo, oldest first; a click goes there.
HistoryActions drawHistoryPanel(const HistoryView& view, HistoryState& state);

}  // namespace dollytrack::ui
