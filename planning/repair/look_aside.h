#pragma once

#include "engine/plan/plan.h"
#include "planning/repair/low_runs.h"
#include "planning/repair/repair_context.h"

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// A look-aside view between two key frames.
struct LookAside {
    SegmentId segment;
    double share = 0.5;                                  // of the segment's arc length, 0..1
    Eigen::Vector3d looks_at = Eigen::Vector3d::Zero();  // point to look at, world, m
};

/// The point to look at from the middle of a low-scoring run that gives the best image score there.
/// Candidates are the nearest targets within 5 m that need at most 90 degrees of additional
/// turning. Empty if no view reaches the threshold.
[[nodiscard]] std::optional<Eigen::Vector3d> findLookAside(
    const RepairContext& context, const Trajectory& trajectory,
    const std::vector<std::vector<Eigen::AlignedBox2d>>& boxes, const LowRun& run);

/// The paths with the look-aside views inserted as keys between their key frames.
[[nodiscard]] std::vector<SmoothPath> withLookAsides(std::vector<SmoothPath> paths,
                                                     const std::vector<LookAside>& look_asides);

}  // namespace dollytrack::planning
