#pragma once

#include <optional>
#include <vector>

namespace dollytrack::statistics {

/// A quantity along the trajectory, for a line chart.
struct TrajectoryLine {
    std::vector<double> time_s;
    std::vector<std::optional<double>> values;  // nothing: the line is interrupted
};

/// At most 300 points: each is a frame, or the mean of several consecutive frames of a long
/// trajectory.
[[nodiscard]] TrajectoryLine trajectoryLineOf(const std::vector<double>& time_s,
                                              const std::vector<std::optional<double>>& values);

}  // namespace dollytrack::statistics
