#pragma once

#include "ui/panels/timeline/timeline_panel.h"

namespace dollytrack::ui {

/// Time of a frame, s. Fractional frames are interpolated linearly; outside the trajectory times
/// continue at equal intervals.
[[nodiscard]] double timeOf(const TimelineView& view, double frame);

/// Inverse of timeOf(): the fractional frame at a time.
[[nodiscard]] double frameAt(const TimelineView& view, double time_s);

}  // namespace dollytrack::ui
