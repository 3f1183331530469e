#pragma once

#include "ui/panels/timeline/timeline_panel.h"

#include <optional>

namespace dollytrack::ui {

/// Draws the timeline below its buttons: ruler, rooms, key frames and strips over one axis. The
/// left button selects a frame (returned if it is a new one), the wheel zooms, the middle button
/// pans.
std::optional<int> drawTimelineTracks(const TimelineView& view, TimelineState& state);

}  // namespace dollytrack::ui
