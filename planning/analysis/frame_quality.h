#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/frame_quality.h"

namespace dollytrack::planning {

class ViewEstimator;
struct PlanParams;
struct PlanningEnvironment;

/// Share of the image at `pose` whose surface the image at `before` shows too, 0..1, by 16 x 12
/// rays: the point is in that image and nothing is in front of it. A ray without a hit counts as a
/// point far away.
[[nodiscard]] double imageOverlap(const ViewEstimator& views, const Pose& pose, const Pose& before);

/// Measures the frames of a plan of any objective. Image corners and surface shares that the plan
/// already contains are reused: it has the former if trackability=on, the latter if objective is
/// surface or both. Error: Cancelled.
Result<FrameQuality> measureFrameQuality(const PlanningEnvironment& environment,
                                         const PlanParams& params, const Plan& plan,
                                         const JobContext& job);

}  // namespace dollytrack::planning
