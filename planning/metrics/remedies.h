#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"
#include "planning/plan_params.h"

#include <memory>
#include <vector>

namespace dollytrack::planning {

/// Searches for what would get each object of `rows` captured, or captured well, that is not: the
/// rows come back with their remedies. A remedy is kept only when planning again with it does what
/// it promises; the mildest kind that does is taken:
/// what was lost on the way given back (budget, path, smoothing, by hand), a pinned point at a
/// legal place that the search missed, a looser pitch band, a no-go box or the height band out of
/// the way, a smaller camera, another lens, and last an object put elsewhere. A row whose legal
/// view was missed says so; what no place at all sees says that. `plan` is the outcome of these
/// very parameters and edits. Plans several times, so it takes seconds. Error: Cancelled, and as
/// Pipeline::run().
Result<std::vector<LedgerRow>> findRemedies(const std::shared_ptr<const Scene>& scene,
                                            const PlanParams& params, const PlanEdits& edits,
                                            const Plan& plan, std::vector<LedgerRow> rows,
                                            const JobContext& job);

}  // namespace dollytrack::planning
