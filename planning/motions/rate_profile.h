#pragma once

#include "planning/timing/motion_limits.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::planning {

/// A piece of a path to be timed: a straight move with a turn.
struct TimedPiece {
    Eigen::Vector3d move = Eigen::Vector3d::Zero();  // m
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();  // rotation vector, rad
    double given_s = 0.0;                            // time as given; 0: none
    bool retime = false;                             // takes what the limits ask
    double slowdown = 1.0;                           // factor of its largest speed

    // Results of setTimes().
    bool changed = false;                     // its time is not the given one
    double time_s = 0.0;                      // never less than given
    double start_rate = 0.0, end_rate = 0.0;  // speeds at both ends, in any unit; see shareAt()

    /// Share of the piece done after a share of its time.
    [[nodiscard]] double shareAt(double time_share) const;
};

/// Gives every piece its time. Pieces to be retimed go as fast as given or as the limits allow;
/// where speeds differ at a joint, the faster side ramps. Pieces as given are changed only where
/// such a ramp reaches into them. Changes of direction count over `interval_s`. The camera stands
/// at the ends of the path if it is retimed there.
void setTimes(std::vector<TimedPiece>& pieces, const MotionLimits& limits, double interval_s);

}  // namespace dollytrack::planning
