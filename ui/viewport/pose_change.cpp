#include "ui/viewport/pose_change.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::ui {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kSteepest_rad = 88.0 / kDegrees;  // steeper views could tip over

/// At most three decimals, without trailing zeros and without "-0".
std::string shortNumber(double value) {
    const double rounded = std::round(value * 1e3) / 1e3;
    return fmt::format("{:.10g}", rounded == 0.0 ? 0.0 : rounded);
}

/// Angle of the view above level.
double pitchOf(const Pose& pose) {
    return std::asin(std::clamp(pose.forward().z(), -1.0, 1.0));
}

double snappedTo(double value, double step) {
    return step > 0.0 ? std::round(value / step) * step : value;
}

/// The change without its steps.
std::string exactText(GizmoPart part, const MoveAxes& axes, const PoseChange& change) {
    if (part == GizmoPart::Yaw) {
        return fmt::format("Rotate about z: {}\u00b0", shortNumber(change.yaw_rad * kDegrees));
    }
    if (part == GizmoPart::Pitch) {
        return fmt::format("Tilt: {}\u00b0", shortNumber(change.pitch_rad * kDegrees));
    }
    if (const auto axis = moveAxis(part)) {
        return fmt::format("Move along {}{}: {} m", axes.own ? "its own " : "", "xyz"[*axis],
                           shortNumber(change.offset_m.dot(axes.direction(*axis))));
    }
    if (lockedAxis(part)) {
        const std::vector<int> plane = axesOf(part);
        const auto along = [&](int axis) {
            return shortNumber(change.offset_m.dot(axes.direction(axis)));
        };
        return fmt::format("Move in {} {}{} plane: {}, {} m", axes.own ? "its own" : "the",
                           "xyz"[plane[0]], "xyz"[plane[1]], along(plane[0]), along(plane[1]));
    }
    const Eigen::Vector3d& by = change.offset_m;
    return fmt::format("Move: x {}, y {}, z {} m", shortNumber(by.x()), shortNumber(by.y()),
                       shortNumber(by.z()));
}

}  // namespace

std::optional<int> moveAxis(GizmoPart part) {
    const int axis = static_cast<int>(part) - static_cast<int>(GizmoPart::MoveX);
    return axis >= 0 && axis < 3 ? std::optional(axis) : std::nullopt;
}

GizmoPart moveAlong(int axis) {
    return static_cast<GizmoPart>(static_cast<int>(GizmoPart::MoveX) + axis);
}

std::optional<int> lockedAxis(GizmoPart part) {
    const int axis = static_cast<int>(part) - static_cast<int>(GizmoPart::MoveYZ);
    return axis >= 0 && axis < 3 ? std::optional(axis) : std::nullopt;
}

GizmoPart moveWithout(int axis) {
    return static_cast<GizmoPart>(static_cast<int>(GizmoPart::MoveYZ) + axis);
}

std::vector<int> axesOf(GizmoPart part) {
    if (const auto axis = moveAxis(part)) return {*axis};
    std::vector<int> axes;
    if (part != GizmoPart::MoveFree && !lockedAxis(part)) return axes;
    for (int axis = 0; axis < 3; ++axis) {
        if (axis != lockedAxis(part)) axes.push_back(axis);
    }
    return axes;
}

Eigen::Vector3d MoveAxes::direction(int axis) const {
    if (!own || axis == 2) return Eigen::Vector3d::Unit(axis);
    const double angle = heading_rad + 0.5 * std::numbers::pi * axis;
    return {std::cos(angle), std::sin(angle), 0.0};
}

PoseChange PoseChange::appliedTo(const Pose& begin) const {
    PoseChange applied = *this;
    if (pitch_rad == 0.0) return applied;
    const double pitch = pitchOf(begin);
    // A view that is already steeper may stay.
    applied.pitch_rad = std::clamp(pitch + pitch_rad, std::min(pitch, -kSteepest_rad),
                                   std::max(pitch, kSteepest_rad)) -
                        pitch;
    return applied;
}

Pose PoseChange::of(const Pose& begin) const {
    Pose pose = begin;
    pose.position += offset_m;
    if (yaw_rad == 0.0 && pitch_rad == 0.0) return pose;
    const Eigen::Vector3d way = begin.forward();
    const double yaw = std::atan2(way.y(), way.x()) + yaw_rad;
    const double pitch = pitchOf(begin) + appliedTo(begin).pitch_rad;
    pose.rotation = lookAlong(
        {std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)});
    return pose;
}

SnapSteps snapSteps(bool ctrl, bool shift) {
    if (!ctrl) return {};
    return shift ? SnapSteps{0.01, 1.0} : SnapSteps{0.1, 15.0};
}

PoseChange snapped(GizmoPart part, const MoveAxes& axes, const PoseChange& change,
                   const SnapSteps& steps) {
    PoseChange result = change;
    result.yaw_rad = snappedTo(change.yaw_rad, steps.turn_deg / kDegrees);
    result.pitch_rad = snappedTo(change.pitch_rad, steps.turn_deg / kDegrees);
    const MoveAxes along = part == GizmoPart::MoveFree ? MoveAxes() : axes;
    result.offset_m.setZero();
    for (const int axis : axesOf(part)) {
        const Eigen::Vector3d way = along.direction(axis);
        result.offset_m += snappedTo(change.offset_m.dot(way), steps.move_m) * way;
    }
    return result;
}

std::string changeText(GizmoPart part, const MoveAxes& axes, const PoseChange& change,
                       const SnapSteps& steps) {
    std::string text = exactText(part, axes, change);
    if (steps.move_m <= 0.0) return text;
    const bool turns = part == GizmoPart::Yaw || part == GizmoPart::Pitch;
    return text + (turns ? fmt::format(" (steps of {:g}\u00b0)", steps.turn_deg)
                         : fmt::format(" (steps of {:g} m)", steps.move_m));
}

}  // namespace dollytrack::ui
