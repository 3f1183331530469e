#pragma once

#include "ui/panels/timeline/timeline_panel.h"
#include "ui/widgets/frame_axis.h"

#include <imgui.h>

namespace dollytrack::ui {

/// How one thing measured a frame is named and drawn.
struct StripStyle {
    const char* name;   // "clearance": in the item map
    const char* title;  // for people
    const char* unit;
    int digits;
    float hue;  // of its colour, 0..1
};
[[nodiscard]] const StripStyle& stripStyle(TimelineStrip strip);

/// Whether the series belongs to the trajectory on the screen.
[[nodiscard]] bool hasSeries(const TimelineView& view);
/// "0.42 m"
[[nodiscard]] std::string stripText(const FrameSeries& series, TimelineStrip strip, int frame);
/// Smallest and largest of what the axis shows: "0.10 – 1.92 m".
[[nodiscard]] std::string stripRange(const FrameSeries& series, TimelineStrip strip,
                                     const FrameAxis& axis);

/// Draws the values into the rectangle between top and bottom (px), under the axis.
void drawStrip(const TimelineView& view, TimelineStrip strip, const FrameAxis& axis, float top,
               float bottom);

}  // namespace dollytrack::ui
