#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"
#include "planning/plan_params.h"

#include <memory>
#include <vector>

namespace dollytrack::planning {

/// Searches for a remedy for each object of `rows` that is not captured, or not captured well, and
/// returns the rows with their remedies. A remedy is kept only if planning with it achieves what it
/// promises. The mildest kind that costs no other capture is taken, else the one with the best
/// balance. Kinds: undoing what lost the view later (budget, path, smoothing, manual edit); pinning
/// a legal view that the search missed; a looser pitch band; removing a no-go box or widening the
/// height band; a smaller camera; another lens; moving an object (tried by planning without it).
/// Also corrects a row's reason if the dense search knows better. `plan` must be the result of
/// these parameters and edits. A given camera motion has no remedies. Plans several times, so it
/// takes seconds. Errors: Cancelled, and those of Pipeline::run().
Result<std::vector<LedgerRow>> findRemedies(const std::shared_ptr<const Scene>& scene,
                                            const PlanParams& params, const PlanEdits& edits,
                                            const Plan& plan, std::vector<LedgerRow> rows,
                                            const JobContext& job);

}  // namespace dollytrack::planning
