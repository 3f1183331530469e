#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

struct HistoryView {
    const std::vector<std::string>* names = nullptr;  // CommandStack::names()
    std::size_t position = 0;                         // index of the current state in `names`
};

/// State kept between window frames.
struct HistoryState {
    std::size_t shown_position = 0;  // to scroll only when the position has changed
    std::size_t shown_count = 0;
};

struct HistoryActions {
    std::optional<std::size_t> go_to;  // CommandStack::goTo()
};

/// Draws the undo history, oldest first; clicking an entry returns to that state.
HistoryActions drawHistoryPanel(const HistoryView& view, HistoryState& state);

}  // namespace dollytrack::ui
