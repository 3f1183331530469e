#pragma once

#include "engine/plan/image_score.h"
#include "planning/repair/repair.h"

namespace dollytrack::planning {

/// What each step of a repair needs to know. References must outlive it.
struct RepairContext {
    const TrajectoryMaker& maker;
    const Surroundings& around;
    ScoreWeights weights;
    double threshold = 0.0;  // a frame that scores less is low
    int seed = 1;
};

}  // namespace dollytrack::planning
