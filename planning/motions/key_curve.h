#pragma once

#include "engine/document/given_motion.h"

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace dollytrack::planning {

/// The smooth motion through key poses. The path of the positions consists of cubic Bezier curves
/// and does not depend on the times of the keys, so that retiming changes the speed only. Speed and
/// turn rate are continuous; the camera rests at the first and the last key, and where the path
/// turns back by more than 120 degrees. Without roll in the keys, there is none between them.
class KeyCurve {
  public:
    explicit KeyCurve(std::span<const MotionKey> keys);

    /// Sets the times of the keys, s, rising.
    void setTimes(std::vector<double> times_s);

    /// Length of the path between a key and the next one, m, and the least angle turned, rad.
    [[nodiscard]] double length_m(std::size_t segment) const {
        return segments_[segment].length_m();
    }
    [[nodiscard]] double turn_rad(std::size_t segment) const {
        return segments_[segment].turn.norm();
    }

    /// The pose at a time after key `segment` and up to the next one; exact at both keys.
    [[nodiscard]] Pose at(std::size_t segment, double time_s) const;

  private:
    static constexpr int kSteps = 64;
    using Angles = Eigen::Vector3d;  // heading, elevation, and a zero, rad

    struct Segment {
        std::array<Eigen::Vector3d, 4> controls;     // of the Bezier curve
        std::array<double, kSteps + 1> arcs_m = {};  // length up to equal steps of the parameter
        Eigen::Vector3d turn;  // of the angles, or as a rotation vector in the camera's axes, rad
        [[nodiscard]] double length_m() const { return arcs_m.back(); }
    };

    void makePath();
    void makeTurns();
    [[nodiscard]] Eigen::Vector3d positionAt(const Segment& segment, double arc_m) const;
    [[nodiscard]] Eigen::Quaterniond rotationAt(std::size_t segment, double share) const;

    std::vector<Pose> poses_;  // of the keys
    std::vector<Segment> segments_;
    std::vector<char> turns_back_;  // by key
    bool level_ = false;            // no key has roll
    std::vector<Angles> angles_;    // by key, if level; headings without jumps
    std::vector<double> times_s_;
    std::vector<double> speeds_mps_;           // at the keys
    std::vector<Eigen::Vector3d> turn_rates_;  // at the keys, rad/s, as `turn`
};

}  // namespace dollytrack::planning
