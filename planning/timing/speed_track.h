#pragma once

#include "engine/plan/camera_path.h"
#include "planning/timing/motion_limits.h"

#include <cstddef>
#include <vector>

namespace dollytrack::planning {

/// How fast the camera may be along one smoothed path, and how fast it is when it passes each key
/// frame at a whole number of frame intervals. The path is cut into short steps; within a step the
/// acceleration is constant, so that speed is continuous and its square is linear over arc length.
class SpeedTrack {
  public:
    SpeedTrack(const SmoothPath& path, const MotionLimits& limits);

    [[nodiscard]] std::size_t stretchCount() const { return key_nodes_.size() - 1; }

    /// Frame intervals that each stretch from key to key takes, at the fewest found: no less than
    /// `least_times_s` and what the limits of motion ask for. Settles the speed at each key.
    std::vector<std::size_t> settle(double interval_s, const std::vector<double>& least_times_s);

    /// Arc lengths at even times within a stretch that takes `time_s` in all, the ends left out;
    /// after settle(), which has to have given it that time.
    [[nodiscard]] std::vector<double> arcs(std::size_t stretch, double time_s,
                                           std::size_t intervals) const;

  private:
    struct Node {
        double arc_m = 0.0;
        double limit2 = 0.0;    // of the squared speed here
        double gain2 = 0.0;     // most that the squared speed changes to the next node
        double fastest2 = 0.0;  // with the speeds at the keys
        double slowest2 = 0.0;  // likewise: no camera brakes harder
    };

    void cut(const SmoothPath& path, const MotionLimits& limits);
    void addSteps(const SmoothPath::Piece& piece, double from, double to,
                  const MotionLimits& limits);
    void findFastest();
    void findSlowest(std::size_t stretch);
    [[nodiscard]] double timeAtCap(std::size_t stretch, double cap2) const;
    [[nodiscard]] double capFor(std::size_t stretch, double time_s) const;
    [[nodiscard]] double speed2(std::size_t node, double cap2) const;

    std::vector<Node> nodes_;
    std::vector<std::size_t> key_nodes_;
    std::vector<double> key_limit2_;
};

}  // namespace dollytrack::planning
