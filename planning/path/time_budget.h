#pragma once

#include "engine/core/result.h"
#include "engine/plan/plan.h"

#include <functional>
#include <optional>
#include <vector>

namespace dollytrack::planning {

/// The paths through a roadmap, with the cycle edges marked.
struct Paths {
    Roadmap roadmap;
    std::vector<CameraPath> paths;
};

/// How paths are taken and measured while their length is searched for.
struct TimedPaths {
    std::function<Result<Paths>(double max_length_m)> take;   // 0: any length
    std::function<Result<std::size_t>(const Paths&)> frames;  // at the motion's limits
};

/// Paths whose frames are at most `most_frames`: those of the greatest length that a bisection
/// finds, up to `max_length_m` (0: any). Nothing where even the paths that must be taken have more
/// frames. Errors: those of `take` and `frames`.
Result<std::optional<Paths>> pathsWithinFrames(const TimedPaths& timed, double max_length_m,
                                               std::size_t most_frames);

}  // namespace dollytrack::planning
