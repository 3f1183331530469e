#include "planning/motions/key_curve.h"

#include "planning/motions/time_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace dollytrack::planning {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kSmallest_m = 1e-9;
constexpr double kLevel = 1e-6;            // largest vertical part of the camera's x axis
constexpr double kTurnsBackCosine = -0.5;  // of the angle between the chords at a key
constexpr double kRound = 2.0 * std::numbers::pi;

bool isLevel(const Quaterniond& rotation) {
    return std::abs((rotation * Vector3d::UnitX()).z()) < kLevel &&
           (rotation * Vector3d::UnitY()).z() < kLevel;
}

/// Heading and elevation. The heading is that of the camera's x axis, which a camera without roll
/// also has where it looks straight up or down.
Vector3d anglesOf(const Quaterniond& rotation) {
    const Vector3d right = rotation * Vector3d::UnitX();
    const Vector3d forward = rotation * Vector3d::UnitZ();
    return {std::atan2(right.x(), -right.y()), std::asin(std::clamp(forward.z(), -1.0, 1.0)), 0.0};
}

Quaterniond rotationOf(const Vector3d& angles) {
    const Vector3d ahead(std::cos(angles[0]), std::sin(angles[0]), 0.0);
    const Vector3d right(ahead.y(), -ahead.x(), 0.0);
    return lookAlong(std::cos(angles[1]) * ahead + std::sin(angles[1]) * Vector3d::UnitZ(), right);
}

Quaterniond turnBy(const Vector3d& rotation_vector) {
    const double angle = rotation_vector.norm();
    if (!(angle > 0.0)) return Quaterniond::Identity();
    return Quaterniond(Eigen::AngleAxisd(angle, rotation_vector / angle));
}

/// The rate at a key between two segments with these durations and mean rates, such that the motion
/// nowhere overshoots (Fritsch and Butland, 1984).
double rateBetween(double before_s, double before, double after_s, double after) {
    if (!(before * after > 0.0)) return 0.0;
    const double w1 = 2.0 * after_s + before_s;
    const double w2 = after_s + 2.0 * before_s;
    return (w1 + w2) / (w1 / before + w2 / after);
}

/// The cubic from 0 to `change` with these slopes at its ends, at a share of its time.
double hermite(double share, double change, double slope0, double slope1) {
    const double u = share;
    return change * u * u * (3.0 - 2.0 * u) + slope0 * u * (1.0 - u) * (1.0 - u) -
           slope1 * u * u * (1.0 - u);
}

Vector3d bezierAt(const std::array<Vector3d, 4>& p, double u) {
    const double v = 1.0 - u;
    return v * v * v * p[0] + 3.0 * v * v * u * p[1] + 3.0 * v * u * u * p[2] + u * u * u * p[3];
}

}  // namespace

KeyCurve::KeyCurve(std::span<const MotionKey> keys) {
    std::vector<double> times_s;
    for (const MotionKey& key : keys) {
        poses_.push_back(key.pose);
        times_s.push_back(key.time_s);
    }
    makePath();
    makeTurns();
    setTimes(std::move(times_s));
}

/// Centripetal Catmull-Rom curves (Yuksel et al., 2011), which have neither cusps nor loops within
/// a segment.
void KeyCurve::makePath() {
    const std::size_t count = poses_.size();
    segments_.resize(count - 1);
    turns_back_.assign(count, 0);
    const auto chord = [&](std::size_t i) -> Vector3d {
        return poses_[i + 1].position - poses_[i].position;
    };
    std::vector<Vector3d> tangents(count, Vector3d::Zero());  // per unit of the square root of m
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double before = chord(i - 1).norm();
        const double after = chord(i).norm();
        if (before < kSmallest_m || after < kSmallest_m) continue;
        turns_back_[i] = chord(i - 1).dot(chord(i)) < kTurnsBackCosine * before * after ? 1 : 0;
        const double a = std::sqrt(before);
        const double b = std::sqrt(after);
        tangents[i] = chord(i - 1) / a - (chord(i - 1) + chord(i)) / (a + b) + chord(i) / b;
    }
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const double width = std::sqrt(chord(i).norm());
        const Vector3d& from = poses_[i].position;
        const Vector3d& to = poses_[i + 1].position;
        Vector3d near_from = from + width / 3.0 * tangents[i];
        Vector3d near_to = to - width / 3.0 * tangents[i + 1];
        // Natural end condition: the curvature is zero at the first and the last key.
        if (i == 0) near_from = 0.5 * (from + (count == 2 ? to : near_to));
        if (i + 2 == count) near_to = 0.5 * (to + (count == 2 ? from : near_from));
        Segment& segment = segments_[i];
        segment.controls = {from, near_from, near_to, to};
        Vector3d last = from;
        for (int k = 1; k <= kSteps; ++k) {
            const Vector3d next = bezierAt(segment.controls, static_cast<double>(k) / kSteps);
            segment.arcs_m[k] = segment.arcs_m[k - 1] + (next - last).norm();
            last = next;
        }
    }
}

void KeyCurve::makeTurns() {
    level_ = std::ranges::all_of(poses_, [](const Pose& pose) { return isLevel(pose.rotation); });
    for (const Pose& pose : poses_) {
        Angles angles = anglesOf(pose.rotation);
        if (!angles_.empty()) {
            const double before = angles_.back()[0];
            angles[0] = before + std::remainder(angles[0] - before, kRound);
        }
        angles_.push_back(angles);
    }
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        segments_[i].turn =
            level_ ? Vector3d(angles_[i + 1] - angles_[i])
                   : rotationVector(Quaterniond::Identity(),
                                    poses_[i].rotation.conjugate() * poses_[i + 1].rotation);
    }
}

void KeyCurve::setTimes(std::vector<double> times_s) {
    times_s_ = std::move(times_s);
    speeds_mps_.assign(poses_.size(), 0.0);
    turn_rates_.assign(poses_.size(), Vector3d::Zero());
    for (std::size_t i = 1; i + 1 < poses_.size(); ++i) {
        const Segment& in = segments_[i - 1];
        const Segment& out = segments_[i];
        const double before_s = times_s_[i] - times_s_[i - 1];
        const double after_s = times_s_[i + 1] - times_s_[i];
        if (!turns_back_[i]) {
            speeds_mps_[i] =
                rateBetween(before_s, in.length_m() / before_s, after_s, out.length_m() / after_s);
        }
        for (int axis = 0; axis < 3; ++axis) {
            turn_rates_[i][axis] =
                rateBetween(before_s, in.turn[axis] / before_s, after_s, out.turn[axis] / after_s);
        }
    }
}

Pose KeyCurve::at(std::size_t segment, double time_s) const {
    const double duration_s = times_s_[segment + 1] - times_s_[segment];
    const double share = (time_s - times_s_[segment]) / duration_s;
    if (share <= 0.0) return poses_[segment];
    if (share >= 1.0) return poses_[segment + 1];
    const double arc_m =
        hermite(share, segments_[segment].length_m(), duration_s * speeds_mps_[segment],
                duration_s * speeds_mps_[segment + 1]);
    return {positionAt(segments_[segment], arc_m), rotationAt(segment, share)};
}

Vector3d KeyCurve::positionAt(const Segment& segment, double arc_m) const {
    const auto& arcs = segment.arcs_m;
    const auto above = std::upper_bound(arcs.begin() + 1, arcs.end() - 1, arc_m);
    const auto k = static_cast<std::size_t>(above - arcs.begin()) - 1;
    const double step = arcs[k + 1] - arcs[k];
    const double rest = step > 0.0 ? std::clamp((arc_m - arcs[k]) / step, 0.0, 1.0) : 0.0;
    return bezierAt(segment.controls, (static_cast<double>(k) + rest) / kSteps);
}

Quaterniond KeyCurve::rotationAt(std::size_t segment, double share) const {
    const double duration_s = times_s_[segment + 1] - times_s_[segment];
    const Vector3d slope0 = duration_s * turn_rates_[segment];
    const Vector3d slope1 = duration_s * turn_rates_[segment + 1];
    if (level_) {
        Angles angles = angles_[segment];
        for (int axis = 0; axis < 2; ++axis) {
            angles[axis] +=
                hermite(share, segments_[segment].turn[axis], slope0[axis], slope1[axis]);
        }
        return rotationOf(angles);
    }
    // A Bezier curve of quaternions (Shoemake, 1985), whose rates at its ends are those of the
    // keys.
    const Quaterniond& from = poses_[segment].rotation;
    const Quaterniond& to = poses_[segment + 1].rotation;
    std::array<Quaterniond, 4> q = {from, from * turnBy(slope0 / 3.0), to * turnBy(-slope1 / 3.0),
                                    to};
    for (std::size_t left = 3; left > 0; --left) {
        for (std::size_t i = 0; i < left; ++i) q[i] = q[i].slerp(share, q[i + 1]);
    }
    return q[0].normalized();
}

}  // namespace dollytrack::planning
