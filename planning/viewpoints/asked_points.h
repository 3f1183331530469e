#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/jobs/job.h"
#include "planning/coverage/must_see.h"
#include "planning/viewpoints/hand_placed.h"

#include <vector>

namespace dollytrack::planning {

/// Points with those added that a person asks for beside the objects'.
struct AskedPoints {
    PlacedPoints placed;
    std::vector<MustSee> must_see;
};

/// Adds the views of must-see regions as fixed points and completes what they capture. Error:
/// Cancelled.
Result<AskedPoints> addAskedPoints(const PlacedPoints& placed, const std::vector<Region>& must_see,
                                   const Surroundings& around, ShownMemo* memo,
                                   const JobContext& job);

}  // namespace dollytrack::planning
