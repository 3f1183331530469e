#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

namespace dollytrack::planning {

struct SmoothingParams;
struct Surroundings;

/// Rounds the corners of a path with quadratic Bezier curves (paper, 3.2.3), from
/// `corner_distance_m` before to after each corner, at most half a leg. Where the swept camera
/// sphere would touch something, or a key frame would lose an object it captures, the set-back
/// shrinks; reversals, pinned points and corners that allow none stop and turn. Error: Cancelled.
Result<SmoothPath> smoothPath(const CameraPath& path,
                              const std::vector<PositionPoint>& position_points,
                              const std::vector<ObservationPoint>& observation_points,
                              const Surroundings& around, const SmoothingParams& params,
                              const JobContext& job);

/// The paper's own smoothing, for comparison: every corner rounded at the same set-back, at most
/// half a leg, whatever is in the way; what it hits is counted in the result.
SmoothPath smoothBlindly(const CameraPath& path, double corner_distance_m,
                         const Surroundings& around);

}  // namespace dollytrack::planning
