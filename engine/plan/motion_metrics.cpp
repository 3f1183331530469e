#include "engine/plan/motion_metrics.h"

#include "engine/math/quantile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dollytrack {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

SampleStatistics spreadOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    return {quantile(values, 0.5), quantile(values, 0.95), values.back()};
}

/// Rotation from one orientation to another as a rotation vector in the camera's frame.
Eigen::Vector3d turnBetween(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
    Eigen::Quaterniond turn = from.conjugate() * to;
    if (turn.w() < 0.0) turn.coeffs() *= -1.0;
    const double sine = turn.vec().norm();
    return sine > 0.0 ? Eigen::Vector3d(turn.vec() * (2.0 * std::atan2(sine, turn.w()) / sine))
                      : Eigen::Vector3d::Zero();
}

/// Linear and angular velocity, or a derivative of them, at a time.
struct Sample {
    double time_s = 0.0;
    Eigen::Vector3d linear;   // world
    Eigen::Vector3d angular;  // in the camera's frame
};

/// The mean rate of change between two samples.
Sample changeBetween(const Sample& a, const Sample& b) {
    const double step_s = b.time_s - a.time_s;
    return {0.5 * (a.time_s + b.time_s), (b.linear - a.linear) / step_s,
            (b.angular - a.angular) / step_s};
}

}  // namespace

MotionMetrics measureMotion(const Trajectory& trajectory) {
    const std::vector<TrajectoryFrame> frames = motionFrames(trajectory);
    std::vector<double> speeds, turns, accelerations, turn_accelerations, jerks;
    // Of the current path. A difference of two values is the rate of change at the mean of their
    // times.
    std::vector<Sample> velocities, velocity_changes;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const double step_s = frames[i].time_s - frames[i - 1].time_s;
        if (frames[i].path != frames[i - 1].path || step_s <= 0.0) {
            velocities.clear();
            velocity_changes.clear();
            continue;
        }
        Sample velocity;
        velocity.time_s = 0.5 * (frames[i].time_s + frames[i - 1].time_s);
        velocity.linear = (frames[i].pose.position - frames[i - 1].pose.position) / step_s;
        velocity.angular =
            kDegrees / step_s * turnBetween(frames[i - 1].pose.rotation, frames[i].pose.rotation);
        speeds.push_back(velocity.linear.norm());
        turns.push_back(velocity.angular.norm());
        velocities.push_back(velocity);
        if (velocities.size() < 2) continue;
        velocity_changes.push_back(changeBetween(velocities.end()[-2], velocities.back()));
        accelerations.push_back(velocity_changes.back().linear.norm());
        turn_accelerations.push_back(velocity_changes.back().angular.norm());
        if (velocity_changes.size() < 2) continue;
        jerks.push_back(
            changeBetween(velocity_changes.end()[-2], velocity_changes.back()).linear.norm());
    }
    return {spreadOf(std::move(speeds)), spreadOf(std::move(turns)),
            spreadOf(std::move(accelerations)), spreadOf(std::move(turn_accelerations)),
            spreadOf(std::move(jerks))};
}

}  // namespace dollytrack
