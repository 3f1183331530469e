#pragma once

#include "ui/panels/timeline/timeline_panel.h"

namespace dollytrack::ui {

/// Draws the timeline below its buttons: ruler, rooms, key frames and strips over one axis. The
/// left button selects a frame, or selects and drags a camera key; the wheel zooms, the middle
/// button pans.
TimelineActions drawTimelineTracks(const TimelineView& view, TimelineState& state);

}  // namespace dollytrack::ui
