#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "planning/plan_params.h"

#include <optional>
#include <vector>

namespace dollytrack {
struct Plan;
struct PlanEdits;
}  // namespace dollytrack

namespace dollytrack::planning {

class Pipeline;

/// What a plan within a budget captures.
struct CoveragePoint {
    int max_frames = 0;         // 0: no limit
    double max_length_m = 0.0;  // 0: no limit
    int frames = 0;
    double path_length_m = 0.0;
    int captured = 0;  // number of objects
    int well_captured = 0;
    double capture_rate = 0.0;
    double well_captured_rate = 0.0;
    std::optional<double> surface_seen_rate;  // if the objective includes surface
    std::optional<double> surface_covered_rate;
};

/// Captures against the budget of frames and of path length. Each curve ends at the plan's own
/// values.
struct CoverageCurves {
    std::vector<CoveragePoint> by_frames;
    std::vector<CoveragePoint> by_length;
};

/// Plans repeatedly under rising budgets, reusing the pipeline's stages up to the key frames:
/// frames up to `max_frames` (without it, the larger of 300 and the number of key frames), and
/// metres up to the plan's length. `plan` must be the result of these parameters. Errors as
/// Pipeline::run().
Result<CoverageCurves> coverageCurves(Pipeline& pipeline, const PlanParams& params,
                                      const PlanEdits& edits, const Plan& plan,
                                      const JobContext& job);

}  // namespace dollytrack::planning
