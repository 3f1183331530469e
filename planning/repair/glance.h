#pragma once

#include "engine/plan/plan.h"
#include "planning/repair/low_runs.h"
#include "planning/repair/repair_context.h"

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// A look aside between two key frames.
struct Glance {
    StretchName stretch;
    double share = 0.5;                                  // of the way along the stretch's arc
    Eigen::Vector3d looks_at = Eigen::Vector3d::Zero();  // world
};

/// Where the camera could look from the middle of a low run so that the image there scores best:
/// at one of the nearest targets, without turning much more than it does anyway. Nothing when no
/// target shows from there, or none in reach scores as much as the threshold.
[[nodiscard]] std::optional<Eigen::Vector3d> findGlance(
    const RepairContext& context, const Trajectory& trajectory,
    const std::vector<std::vector<Eigen::AlignedBox2d>>& boxes, const LowRun& run);

/// The paths with the glances put in between their key frames.
[[nodiscard]] std::vector<SmoothPath> withGlances(std::vector<SmoothPath> paths,
                                                  const std::vector<Glance>& glances);

}  // namespace dollytrack::planning
