#pragma once

#include "engine/core/result.h"
#include "engine/plan/plan.h"

#include <functional>
#include <optional>
#include <vector>

namespace dollytrack::planning {

/// Paths through a roadmap, with the edges outside the spanning tree marked.
struct Paths {
    Roadmap roadmap;
    std::vector<CameraPath> paths;
};

/// Functions that find paths and measure them, for a search over their length.
struct TimedPaths {
    std::function<Result<Paths>(double max_length_m)> take;   // finds paths of at most this length;
                                                              // 0: any length
    std::function<Result<std::size_t>(const Paths&)> frames;  // number of frames at the limits of
                                                              // motion
};

/// The longest paths with at most `most_frames` frames, found by bisection over the length, up to
/// `max_length_m` (0: any), and then among lengths up to twice the result, because longer paths may
/// need fewer frames. Empty if even the shortest possible paths have more frames. Errors: those of
/// `take` and `frames`.
Result<std::optional<Paths>> pathsWithinFrames(const TimedPaths& timed, double max_length_m,
                                               std::size_t most_frames);

}  // namespace dollytrack::planning
