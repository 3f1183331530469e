#pragma once

#include "planning/plan_params.h"
#include "render/dataset/dataset_job.h"

namespace dollytrack::cli {

/// Warns about settings that are valid but probably unintended: per-frame light that does not vary
/// or is not recorded, settings without effect, a rig camera equal to the planned camera.
void warnOfExport(const planning::PlanParams& params, const render::DatasetSettings& settings);

}  // namespace dollytrack::cli
