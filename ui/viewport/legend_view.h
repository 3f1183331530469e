#pragma once

#include "ui/overlays/legend.h"

#include <imgui.h>

#include <string>
#include <vector>

namespace dollytrack::ui {

/// Draws the legends of the overlays. Names are cut to the column's width, numbers are not.
void drawLegends(const std::vector<Legend>& legends);

struct LegendBoxState {
    bool open = true;  // false: only its title
    bool hovered = false;
    ImVec2 size;                      // content size in the previous frame
    std::vector<std::string> folded;  // titles of the collapsed legends
};

/// Draws the legends in a box in the current window, with its top-left corner at `low` and at most
/// `room` large; longer content scrolls. Clicking a title collapses that legend, or the box.
void drawLegendBox(const std::vector<Legend>& legends, ImVec2 low, ImVec2 room,
                   LegendBoxState& state);

}  // namespace dollytrack::ui
