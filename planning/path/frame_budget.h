#pragma once

#include "engine/document/edits.h"
#include "engine/plan/plan.h"
#include "planning/path/path_search.h"

#include <vector>

namespace dollytrack::planning {

struct PathParams;
struct PlanParams;

/// Largest number of key frames for the budget of frames; 0: no limit.
[[nodiscard]] int mostVisits(const PlanParams& params);

/// Drops key frames from the end of the list until `ends.visits` allows all. The given start and
/// end are kept first. In a loop, the return to each room's first key frame counts as a visit.
[[nodiscard]] std::vector<int> withinBudget(std::vector<int> key_frames,
                                            const std::vector<PositionPoint>& position_points,
                                            const PathEnds& ends);

/// Whether walkTours() chooses which key frames to keep. With path_mode=tour it does so if both the
/// path length and the number of frames are limited, because withinBudget() could drop key frames
/// that lie on the path anyway. False if the stops that must stay (pinned points, and in a loop two
/// per room) may exceed the limit of frames.
[[nodiscard]] bool isChosenByTour(const PathParams& path,
                                  const std::vector<PositionPoint>& position_points,
                                  const PathEnds& ends);

/// Adds a refusal to the plan for every pinned point that a budget of frames dropped.
void refusePinsOverBudget(const PlanEdits& edits, Plan& plan);

}  // namespace dollytrack::planning
