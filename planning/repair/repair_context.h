#pragma once

#include "engine/plan/image_score.h"
#include "planning/repair/repair.h"

namespace dollytrack::planning {

/// Input shared by all steps of a repair. Keeps references.
struct RepairContext {
    const TrajectoryMaker& maker;
    const PlanningEnvironment& environment;
    ScoreWeights weights;
    double threshold = 0.0;  // frames with a smaller score are low
    int seed = 1;
};

}  // namespace dollytrack::planning
