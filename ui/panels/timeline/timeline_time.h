#pragma once

#include "ui/panels/timeline/timeline_panel.h"

namespace dollytrack::ui {

/// When a frame was taken, s; in between, of a share of the way to the next.
[[nodiscard]] double timeOf(const TimelineView& view, double frame);

/// The inverse, not a whole number; before the first and behind the last frame the times go on at
/// even intervals.
[[nodiscard]] double frameAt(const TimelineView& view, double time_s);

}  // namespace dollytrack::ui
