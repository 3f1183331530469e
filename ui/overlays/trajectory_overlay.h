#pragma once

#include "engine/plan/plan.h"
#include "ui/overlays/legend.h"

namespace dollytrack::ui {

/// What the colours along a trajectory say, from Plan::series.
enum class TrajectoryColor { Time, Clearance, Speed, TurnRate, Score, NewlyCaptured };

struct TrajectoryOverlayOptions {
    TrajectoryColor color = TrajectoryColor::Time;
    bool direction_arrows = true;  // every two metres
    int selected_frame = -1;
    bool operator==(const TrajectoryOverlayOptions&) const = default;
};

/// The smoothed trajectory, a piece of line a frame, coloured by a value of that frame. By newly
/// captured objects: a dot where a frame captures some, larger with their number.
[[nodiscard]] PlanLayer trajectoryLayer(const Plan& plan, const TrajectoryOverlayOptions& options);

}  // namespace dollytrack::ui
