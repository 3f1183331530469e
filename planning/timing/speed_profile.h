#pragma once

#include "engine/plan/camera_path.h"
#include "planning/timing/motion_limits.h"

#include <cstddef>
#include <vector>

namespace dollytrack::planning {

/// Speed profile along one smoothed path: the limits of speed, and the speed at which the camera
/// passes each key at a whole number of frame intervals. The path is divided into short steps of
/// constant acceleration, so that speed is continuous and its square is linear in arc length.
class SpeedProfile {
  public:
    SpeedProfile(const SmoothPath& path, const MotionLimits& limits);

    [[nodiscard]] std::size_t segmentCount() const { return key_nodes_.size() - 1; }

    /// The number of frame intervals for each segment between keys, the fewest found: at least
    /// `least_times_s` and what the limits of motion require. Fixes the speed at each key.
    std::vector<std::size_t> settle(double interval_s, const std::vector<double>& least_times_s);

    /// Arc lengths, m, at equal time steps within a segment that takes `time_s`, ends excluded.
    /// Call after settle(), with the time it gave the segment.
    [[nodiscard]] std::vector<double> arcs(std::size_t segment, double time_s,
                                           std::size_t intervals) const;

  private:
    struct Node {
        double arc_m = 0.0;
        double limit2 = 0.0;    // squared speed limit here
        double gain2 = 0.0;     // largest change of the squared speed to the next node
        double fastest2 = 0.0;  // largest squared speed, given the speeds at the keys
        double slowest2 = 0.0;  // smallest squared speed that braking allows
    };

    void cut(const SmoothPath& path, const MotionLimits& limits);
    void addSteps(const SmoothPath::Piece& piece, double from, double to,
                  const MotionLimits& limits);
    void findFastest();
    void findSlowest(std::size_t segment);
    [[nodiscard]] double timeAtCap(std::size_t segment, double cap2) const;
    [[nodiscard]] double capFor(std::size_t segment, double time_s) const;
    [[nodiscard]] double speed2(std::size_t node, double cap2) const;

    std::vector<Node> nodes_;
    std::vector<std::size_t> key_nodes_;
    std::vector<double> key_limit2_;
};

}  // namespace dollytrack::planning
