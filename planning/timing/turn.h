#pragma once

#include "planning/visibility/pitch_band.h"

#include <Eigen/Geometry>

#include <array>

namespace dollytrack::planning {

/// A camera rotation between two roll-free orientations, roll-free throughout. It follows slerp,
/// except where that passes so close to the vertical that the heading would spin, or leaves the
/// pitch band that holds both ends; there heading and elevation are interpolated. It is
/// parametrised by the angle turned, because removing the roll makes slerp's speed uneven.
class Turn {
  public:
    Turn() = default;
    Turn(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to, const PitchBand& band = {});

    /// Total angle turned, rad.
    [[nodiscard]] double angle() const { return turned_.back(); }

    /// Orientation after an angle of 0..angle(), rad; exact at both ends.
    [[nodiscard]] Eigen::Quaterniond at(double turned) const;

    /// Largest change of the unit rotation axis per radian turned. At a constant rate w (rad/s) the
    /// angular acceleration is w * w * bend(), rad/s2.
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
    std::array<double, kSteps + 1> turned_{};  // angle at equal steps of the interpolation, rad
    double bend_ = 0.0;
};

}  // namespace dollytrack::planning
