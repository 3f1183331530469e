#pragma once

#include <Eigen/Geometry>

namespace dollytrack::planning {

/// The turn of a camera from one roll-free orientation to another, itself roll-free. Follows slerp,
/// except where that would pass so near the vertical that the heading spins: there heading and
/// elevation are interpolated.
class Turn {
  public:
    Turn() = default;
    Turn(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to);

    /// t in 0..1; the ends are met to the last bit.
    [[nodiscard]] Eigen::Quaterniond at(double t) const;
    /// The greatest angle turned by in any part of the turn, rad a unit of t: taking the roll out
    /// makes some parts faster than others.
    [[nodiscard]] double greatestRate() const;

  private:
    Eigen::Quaterniond from_ = Eigen::Quaterniond::Identity();
    Eigen::Quaterniond to_ = Eigen::Quaterniond::Identity();
    bool by_angles_ = false;
    double heading_ = 0.0, heading_change_ = 0.0;
    double elevation_ = 0.0, elevation_change_ = 0.0;
};

}  // namespace dollytrack::planning
