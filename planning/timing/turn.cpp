#include "planning/timing/turn.h"

#include "engine/math/pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {

// Slerp may rise this much above its ends before heading and elevation are interpolated instead.
constexpr double kDetour = 10.0 * std::numbers::pi / 180.0;
// From steep views the shortest way to what lies behind leads over the top, where the heading
// flips.
constexpr double kSteep = 50.0 * std::numbers::pi / 180.0;
constexpr double kLargeTurn = 0.5 * std::numbers::pi;
constexpr int kSamples = 64;

double heading(const Eigen::Vector3d& forward) {
    return std::atan2(forward.y(), forward.x());
}
double elevation(const Eigen::Vector3d& forward) {
    return std::asin(std::clamp(forward.z(), -1.0, 1.0));
}

/// How far slerp leads the view above the steeper of its ends, rad.
double risesBy(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to, double highest) {
    double risen = 0.0;
    for (int i = 1; i < 16; ++i) {
        const Eigen::Vector3d f = from.slerp(i / 16.0, to) * Eigen::Vector3d::UnitZ();
        risen = std::max(risen, std::abs(elevation(f)) - highest);
    }
    return risen;
}

}  // namespace

Turn::Turn(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) : from_(from), to_(to) {
    const Eigen::Vector3d a = from * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d b = to * Eigen::Vector3d::UnitZ();
    heading_ = heading(a);
    heading_change_ = std::remainder(heading(b) - heading_, 2.0 * std::numbers::pi);
    elevation_ = elevation(a);
    elevation_change_ = elevation(b) - elevation_;
    const double highest = std::max(std::abs(elevation_), std::abs(elevation(b)));
    const bool over_the_top = highest > kSteep && std::abs(heading_change_) > kLargeTurn;
    by_angles_ = over_the_top || risesBy(from, to, highest) > kDetour;
}

Eigen::Quaterniond Turn::at(double t) const {
    if (t <= 0.0) return from_;
    if (t >= 1.0) return to_;
    if (!by_angles_) return withoutRoll(from_.slerp(t, to_));
    const double yaw = heading_ + t * heading_change_;
    const double pitch = elevation_ + t * elevation_change_;
    return lookAlong(
        {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)},
        {std::sin(yaw), -std::cos(yaw), 0.0});
}

double Turn::greatestRate() const {
    double fastest = 0.0;
    Eigen::Quaterniond last = from_;
    for (int i = 1; i <= kSamples; ++i) {
        const Eigen::Quaterniond next = at(static_cast<double>(i) / kSamples);
        fastest = std::max(fastest, angleBetween(last, next));
        last = next;
    }
    return fastest * kSamples;
}

}  // namespace dollytrack::planning
