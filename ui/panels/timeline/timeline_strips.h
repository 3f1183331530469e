#pragma once

#include "ui/panels/timeline/frame_axis.h"
#include "ui/panels/timeline/timeline_panel.h"

#include <imgui.h>

namespace dollytrack::ui {

/// Name and style of a strip, the plot of one measured value.
struct StripStyle {
    const char* name;   // name in the item map: "clearance"
    const char* title;  // display name
    const char* unit;
    int digits;
    float hue;  // hue of its colour, 0..1
};
[[nodiscard]] const StripStyle& stripStyle(TimelineStrip strip);

/// Whether `view.series` matches the trajectory's frame count.
[[nodiscard]] bool hasSeries(const TimelineView& view);
/// Whether the strip has a value for each frame of the trajectory.
[[nodiscard]] bool hasValues(const TimelineView& view, TimelineStrip strip);
/// Whether the strip has values, or will have them: image corners only with trackability or
/// TimelineView::quality, overlap only with the latter. While a new plan is being measured, the
/// earlier one decides.
[[nodiscard]] bool isMeasured(const TimelineView& view, TimelineStrip strip);
/// Whether the strip is switched on and measured.
[[nodiscard]] bool isShown(const TimelineView& view, const TimelineState& state,
                           TimelineStrip strip);
/// The value at a frame as text: "0.42 m". Requires hasValues(), like the functions below.
[[nodiscard]] std::string stripText(const TimelineView& view, TimelineStrip strip, int frame);
/// Minimum and maximum over the visible frames: "0.10 – 1.92 m".
[[nodiscard]] std::string stripRange(const TimelineView& view, TimelineStrip strip,
                                     const FrameAxis& axis);

/// Plots the values over the visible part of `axis`, between screen rows `top` and `bottom` (px).
void drawStrip(const TimelineView& view, TimelineStrip strip, const FrameAxis& axis, float top,
               float bottom);
/// Plots the values of the plan that was measured before, paler and scaled to the new frame count,
/// so that strips neither flicker nor move while a new plan is measured. Returns
/// false, and draws nothing, if no plan was measured before.
bool drawEarlierStrip(const TimelineView& view, TimelineStrip strip, const FrameAxis& axis,
                      float top, float bottom);

}  // namespace dollytrack::ui
