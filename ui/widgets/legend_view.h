#pragma once

#include "ui/overlays/legend.h"

#include <imgui.h>

#include <string>
#include <vector>

namespace dollytrack::ui {

/// What the signs and colours in the scene mean, as many lines as that takes. Names that are wider
/// than the column are cut, their numbers are not.
void drawLegends(const std::vector<Legend>& legends);

struct LegendBoxState {
    bool open = true;  // else only its title
    bool hovered = false;
    ImVec2 size;                      // of what it held in the frame before
    std::vector<std::string> folded;  // titles of parts that show only those
};

/// The same in a box over the window at hand, with its corner at `low` and within `room`; what is
/// more is scrolled to. A click on a title folds its part, or the box.
void drawLegendBox(const std::vector<Legend>& legends, ImVec2 low, ImVec2 room,
                   LegendBoxState& state);

}  // namespace dollytrack::ui
