#pragma once

#include "engine/camera/trajectory.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace dollytrack {

/// The twice continuously differentiable motion through the frames of one continuous path: a cubic
/// spline of positions and quaternions, each a function of time. At both ends one cubic goes
/// through four frames ("not a knot"), which assumes nothing about how the motion begins.
class PoseSpline {
  public:
    /// Position, then quaternion (x, y, z, w) with signs that make neighbours near; nearly unit.
    using Vector7 = Eigen::Matrix<double, 7, 1>;
    struct Point {
        Vector7 value, velocity, acceleration;  // per s
    };

    /// At least two frames, by rising time.
    explicit PoseSpline(std::span<const TrajectoryFrame> motion);

    /// At a time (s) within the motion.
    [[nodiscard]] Point at(double time_s) const;

    [[nodiscard]] double begin() const { return times_.front(); }
    [[nodiscard]] double end() const { return times_.back(); }

  private:
    void solve();

    std::vector<double> times_;
    std::vector<Vector7> values_;
    std::vector<Vector7> second_;  // derivatives at the times
};

}  // namespace dollytrack
