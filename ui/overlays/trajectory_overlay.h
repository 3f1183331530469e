#pragma once

#include "engine/plan/plan.h"
#include "ui/overlays/legend.h"

#include <string>

namespace dollytrack::ui {

/// The value from Plan::series that colours the trajectory.
enum class TrajectoryColor { Time, Clearance, Speed, TurnRate, Score, NewlyCaptured, ImageCorners };

struct TrajectoryOverlayOptions {
    TrajectoryColor color = TrajectoryColor::Time;
    bool direction_arrows = true;  // every two metres
    int selected_frame = -1;
    bool operator==(const TrajectoryOverlayOptions&) const = default;
};

/// The smoothed trajectory as one line segment per frame, coloured by a value of that frame. For
/// NewlyCaptured, frames that capture new objects also get a dot that grows with their number.
/// Colliding segments of a given motion are red.
[[nodiscard]] PlanLayer trajectoryLayer(const Plan& plan, const TrajectoryOverlayOptions& options);

/// The trajectory of another plan as a thin pale line, for comparison; `name` is that plan's.
[[nodiscard]] PlanLayer keptPlanLayer(const Trajectory& trajectory, const std::string& name);

}  // namespace dollytrack::ui
