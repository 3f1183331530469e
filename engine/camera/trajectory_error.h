#pragma once

#include "engine/camera/trajectory.h"
#include "engine/math/alignment.h"

#include <utility>
#include <vector>

namespace dollytrack {

/// How an estimated trajectory is brought into the world of the true one.
enum class Alignment {
    Rigid,       // turned and moved: what has a scale of its own, as depth or stereo give it
    Similarity,  // scaled, too: a single camera cannot know the scale
    None,        // it is in the true world already
};

struct TrajectoryErrorSettings {
    Alignment alignment = Alignment::Rigid;
    double max_dt_s = 0.02;  // farther apart in time, two poses are not of one frame
    int delta = 1;           // frames from one pose of a relative error to the other
};

/// Figures of a list of errors; zeros for an empty one.
struct ErrorFigures {
    int count = 0;
    double rmse = 0.0;
    double mean = 0.0;
    double median = 0.0;
    double max = 0.0;
};
[[nodiscard]] ErrorFigures figuresOf(std::vector<double> errors);

/// Matched poses that have to be there before an error says anything: fewer always fit.
[[nodiscard]] int posesNeeded(Alignment alignment);

/// What an estimated trajectory is worth.
struct TrajectoryError {
    int frames = 0;                            // of the true trajectory
    std::vector<std::pair<int, int>> matches;  // true and estimated frame, by rising true frame
    Similarity world_from_estimate;            // the alignment
    ErrorFigures absolute_m;                   // distances after alignment
    ErrorFigures relative_m;                   // of motions over `delta` frames
    ErrorFigures relative_rad;
    bool measured = false;  // else too few poses match, and nothing above but those is known

    [[nodiscard]] double trackedShare() const {
        return frames > 0 ? static_cast<double>(matches.size()) / frames : 0.0;
    }
};

/// Pairs of frames that are nearest in time, each in one pair at most, the nearest first. Times
/// rise.
[[nodiscard]] std::vector<std::pair<int, int>> matchByTime(const Trajectory& truth,
                                                           const Trajectory& estimate,
                                                           double max_dt_s);

/// Absolute and relative pose errors. Relative errors are not measured between two separate paths
/// of the ground truth.
[[nodiscard]] TrajectoryError trajectoryError(const Trajectory& truth, const Trajectory& estimate,
                                              const TrajectoryErrorSettings& settings);

}  // namespace dollytrack
