#pragma once

#include "engine/document/edits.h"
#include "engine/plan/plan.h"
#include "planning/path/path_search.h"

#include <vector>

namespace dollytrack::planning {

struct PathParams;

/// Those of the key frames that the ends' limit of visits allows, the ones at both ends first. A
/// loop comes back to one of each room.
[[nodiscard]] std::vector<int> withinBudget(std::vector<int> key_frames,
                                            const std::vector<PositionPoint>& position_points,
                                            const PathEnds& ends);

/// Whether tours choose among the key frames, where both metres and frames are few: what is dropped
/// beforehand might lie on the way. Not where what has to stay may be more than the limit.
[[nodiscard]] bool isChosenByTour(const PathParams& path,
                                  const std::vector<PositionPoint>& position_points,
                                  const PathEnds& ends);

/// A budget may be smaller than the number of pinned points: refuses those of the plan's that are
/// no key frames.
void refusePinsOverBudget(const PlanEdits& edits, Plan& plan);

}  // namespace dollytrack::planning
