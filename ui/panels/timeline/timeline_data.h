#pragma once

#include "engine/plan/plan.h"
#include "engine/scene/scene.h"
#include "ui/panels/timeline/timeline_panel.h"

#include <vector>

namespace dollytrack::ui {

/// The frames of a plan that stand on a position point, with what they capture; where it stays on
/// one for several frames, the first of them.
[[nodiscard]] std::vector<TimelineKey> timelineKeys(const Scene& scene, const Plan& plan);

/// Its rooms, and where a room has several, its paths.
[[nodiscard]] std::vector<TimelineBand> timelineBands(const Plan& plan);

}  // namespace dollytrack::ui
