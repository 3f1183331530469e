#pragma once

#include "planning/plan_params.h"
#include "render/dataset/dataset_job.h"

namespace dollytrack::cli {

/// Says what an export can do but was hardly meant to: light by frame that does not vary or that
/// nothing records, settings that others make idle, a camera that is the planned one once more.
void warnOfExport(const planning::PlanParams& params, const render::DatasetSettings& settings);

}  // namespace dollytrack::cli
