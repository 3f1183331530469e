#pragma once

#include "ui/panels/timeline/timeline_panel.h"

#include <optional>

namespace dollytrack::ui {

/// The part of the timeline below its buttons: ruler, rooms, key frames and strips over one axis.
/// Left button: go there (returned); wheel: zoom; middle button: pan.
std::optional<int> drawTimelineTracks(const TimelineView& view, TimelineState& state);

}  // namespace dollytrack::ui
