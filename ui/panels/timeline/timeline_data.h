#pragma once

#include "engine/plan/plan.h"
#include "engine/scene/scene.h"
#include "ui/panels/timeline/timeline_panel.h"

#include <vector>

namespace dollytrack::ui {

/// The key frames of a plan, with the objects each captures, or the keys of its given motion. If
/// the camera stays at a position point for several frames, only the first is listed.
[[nodiscard]] std::vector<TimelineKey> timelineKeys(const Scene& scene, const Plan& plan);

/// The trajectory divided into rooms (connected components of free space), and by path if a room
/// has several.
[[nodiscard]] std::vector<TimelineBand> timelineBands(const Plan& plan);

}  // namespace dollytrack::ui
