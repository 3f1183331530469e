#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "planning/plan_params.h"

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
    int captured = 0;  // objects
    int well_captured = 0;
    double capture_rate = 0.0;
    double well_captured_rate = 0.0;
};

/// What budgets cost: few frames, short ways. Both rise to the plan without the other's limit.
struct CoverageCurves {
    std::vector<CoveragePoint> by_frames;
    std::vector<CoveragePoint> by_length;
};

/// Plans again and again on the pipeline, from the key frames on, under rising budgets: frames up
/// to `max_frames`, or where that is off as many as the plan has key frames, or 300; metres up to
/// the plan's own length. `plan` is what the parameters give. Errors as Pipeline::run().
Result<CoverageCurves> coverageCurves(Pipeline& pipeline, const PlanParams& params,
                                      const PlanEdits& edits, const Plan& plan,
                                      const JobContext& job);

}  // namespace dollytrack::planning
