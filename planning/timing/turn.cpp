#include "planning/timing/turn.h"

#include "engine/math/pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {

// Slerp may rise this much above its ends before heading and elevation are interpolated instead.
constexpr double kDetour = 10.0 * std::numbers::pi / 180.0;
// From steep views, the shortest rotation to a view behind passes the vertical, where the heading
// flips.
constexpr double kSteepTurn = 50.0 * std::numbers::pi / 180.0;
constexpr double kLargeTurn = 0.5 * std::numbers::pi;
// This close to the vertical the heading is defined by the camera's right side, and slerp would
// start or end with a jump.
constexpr double kVertical = 85.0 * std::numbers::pi / 180.0;

/// Heading from the camera's right axis, which is horizontal and defined even looking straight
/// down.
double heading(const Eigen::Quaterniond& rotation) {
    const Eigen::Vector3d right = rotation * Eigen::Vector3d::UnitX();
    return std::atan2(right.x(), -right.y());
}
double elevation(const Eigen::Vector3d& forward) {
    return std::asin(std::clamp(forward.z(), -1.0, 1.0));
}

/// Largest rise of slerp above the steeper end, rad.
double risesBy(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to, double highest) {
    double risen = 0.0;
    for (int i = 1; i < 16; ++i) {
        const Eigen::Vector3d f = from.slerp(i / 16.0, to) * Eigen::Vector3d::UnitZ();
        risen = std::max(risen, std::abs(elevation(f)) - highest);
    }
    return risen;
}

/// Whether slerp keeps the view within the band. It rotates about one axis, so the view's height
/// follows a cosine with known peaks.
bool slerpStaysIn(const PitchBand& band, const Eigen::Quaterniond& from,
                  const Eigen::Quaterniond& to) {
    if (!band.restricts()) return true;
    Eigen::Quaterniond step = to * from.conjugate();
    if (step.w() < 0.0) step.coeffs() *= -1.0;
    const double sine = step.vec().norm();
    if (sine < 1e-12) return true;
    const Eigen::Vector3d axis = step.vec() / sine;
    const double angle = 2.0 * std::atan2(sine, step.w());
    const Eigen::Vector3d view = from * Eigen::Vector3d::UnitZ();
    const double middle = axis.z() * axis.dot(view);
    const double peak = std::atan2(axis.cross(view).z(), view.z() - middle);
    for (const double at : {peak, peak + std::numbers::pi, peak - std::numbers::pi}) {
        if (at <= 0.0 || at >= angle) continue;
        if (!band.holds(Eigen::Quaterniond(Eigen::AngleAxisd(at, axis)) * from)) return false;
    }
    return true;
}

}  // namespace

Turn::Turn(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to, const PitchBand& band)
    : from_(from), to_(to) {
    const Eigen::Vector3d a = from * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d b = to * Eigen::Vector3d::UnitZ();
    heading_ = heading(from);
    heading_change_ = std::remainder(heading(to) - heading_, 2.0 * std::numbers::pi);
    elevation_ = elevation(a);
    elevation_change_ = elevation(b) - elevation_;
    const double highest = std::max(std::abs(elevation_), std::abs(elevation(b)));
    const bool over_the_top = highest > kSteepTurn && std::abs(heading_change_) > kLargeTurn;
    by_angles_ = over_the_top || highest > kVertical || risesBy(from, to, highest) > kDetour ||
                 !slerpStaysIn(band, from, to);
    measure();
}

Eigen::Quaterniond Turn::byShare(double share) const {
    if (share <= 0.0) return from_;
    if (share >= 1.0) return to_;
    if (!by_angles_) return withoutRoll(from_.slerp(share, to_));
    const double yaw = heading_ + share * heading_change_;
    const double pitch = elevation_ + share * elevation_change_;
    return lookAlong(
        {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)},
        {std::sin(yaw), -std::cos(yaw), 0.0});
}

void Turn::measure() {
    Eigen::Quaterniond last = from_;
    Eigen::Vector3d last_axis = Eigen::Vector3d::Zero();
    double last_step = 0.0;
    for (std::size_t i = 1; i <= kSteps; ++i) {
        const Eigen::Quaterniond now = byShare(static_cast<double>(i) / kSteps);
        Eigen::Quaterniond step = now * last.conjugate();
        if (step.w() < 0.0) step.coeffs() *= -1.0;
        const double sine = step.vec().norm();
        const double angle = 2.0 * std::atan2(sine, step.w());
        turned_[i] = turned_[i - 1] + angle;
        // For smaller angles the axis is rounding noise.
        if (angle > 1e-6) {
            const Eigen::Vector3d axis = step.vec() / sine;
            if (last_step > 0.0) {
                bend_ = std::max(bend_, (axis - last_axis).norm() / (0.5 * (angle + last_step)));
            }
            last_axis = axis;
        }
        last_step = angle > 1e-6 ? angle : 0.0;
        last = now;
    }
}

/// Inverse of the table by cubic Hermite pieces: linear ones would make the turning rate jump from
/// step to step.
double Turn::shareAt(double turned) const {
    const auto above = std::upper_bound(turned_.begin() + 1, turned_.end() - 1, turned);
    const std::size_t i = above - turned_.begin();
    const double width = turned_[i] - turned_[i - 1];
    constexpr double kStep = 1.0 / kSteps;
    const auto begin = static_cast<double>(i - 1) * kStep;
    if (width <= 0.0) return begin;
    // Slope at a step's end, limited so that the cubic stays monotonic.
    const auto slope = [&](std::size_t j) {
        const std::size_t low = j == 0 ? 0 : j - 1;
        const std::size_t high = j == kSteps ? kSteps : j + 1;
        const double angle = turned_[high] - turned_[low];
        const double steepest = 3.0 * kStep / width;
        return angle > 0.0 ? std::min(steepest, static_cast<double>(high - low) * kStep / angle)
                           : steepest;
    };
    const double x = (turned - turned_[i - 1]) / width;
    const double y = 1.0 - x;
    return begin + kStep * x * x * (3.0 - 2.0 * x) +
           width * x * y * (y * slope(i - 1) - x * slope(i));
}

Eigen::Quaterniond Turn::at(double turned) const {
    if (turned <= 0.0) return from_;
    if (turned >= angle()) return to_;
    return byShare(shareAt(turned));
}

}  // namespace dollytrack::planning
