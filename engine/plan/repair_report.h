#pragma once

namespace dollytrack {

/// How well the frames of a trajectory score; see imageScores().
struct ScoreTally {
    int frames = 0;
    int low = 0;  // frames that score less than the threshold
    double mean = 0.0;
    bool operator==(const ScoreTally&) const = default;
};

/// What repair did to a trajectory's low frames.
struct RepairReport {
    int rounds = 0;          // in which something could be tried
    double threshold = 0.0;  // a frame below it is low
    ScoreTally before;
    ScoreTally after;
    int look_asides = 0;  // segments with a look-aside view
    int replanned = 0;    // segments that take a detour
    int dropped = 0;      // frames left out
    bool operator==(const RepairReport&) const = default;
};

}  // namespace dollytrack
