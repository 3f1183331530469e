#pragma once

#include "planning/visibility/pitch_band.h"

#include <Eigen/Geometry>

#include <array>

namespace dollytrack::planning {

/// The turn of a camera from one roll-free orientation to another, itself roll-free. Follows slerp,
/// except where that would pass so near the vertical that the heading spins: there heading and
/// elevation are interpolated, and likewise where it would leave a band of elevations that both
/// ends are in. Measured by the angle turned, so that an even pace is an even turn:
/// taking the roll out makes slerp faster in some parts than in others.
class Turn {
  public:
    Turn() = default;
    Turn(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to, const PitchBand& band = {});

    /// The whole angle turned by on the way, rad.
    [[nodiscard]] double angle() const { return turned_.back(); }

    /// Orientation after an angle of 0..angle(); the ends are met to the last bit.
    [[nodiscard]] Eigen::Quaterniond at(double turned) const;

    /// How much the axis of turning changes a radian turned, at the most. At an even pace of
    /// w rad/s the angular velocity changes by w * w * bend() rad/s2.
    [[nodiscard]] double bend() const { return bend_; }

  private:
    static constexpr int kSteps = 48;

    [[nodiscard]] Eigen::Quaterniond byShare(double share) const;
    [[nodiscard]] double shareAt(double turned) const;
    void measure();

    Eigen::Quaterniond from_ = Eigen::Quaterniond::Identity();
    Eigen::Quaterniond to_ = Eigen::Quaterniond::Identity();
    bool by_angles_ = false;
    double heading_ = 0.0, heading_change_ = 0.0;
    double elevation_ = 0.0, elevation_change_ = 0.0;
    std::array<double, kSteps + 1> turned_{};  // at even shares, rad
    double bend_ = 0.0;
};

}  // namespace dollytrack::planning
