#pragma once

#include "ui/overlays/legend.h"

#include <imgui.h>

#include <vector>

namespace dollytrack::ui {

/// What the signs and colours in the scene mean, as many lines as that takes.
void drawLegends(const std::vector<Legend>& legends);

struct LegendBoxState {
    bool open = true;  // else only its title
    bool hovered = false;
    ImVec2 size;  // of what it held in the frame before
};

/// The same in a box over the window at hand, with its corner at `low` and within `room`. A click
/// on its title folds it.
void drawLegendBox(const std::vector<Legend>& legends, ImVec2 low, ImVec2 room,
                   LegendBoxState& state);

}  // namespace dollytrack::ui
