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

}  // namespace

MotionMetrics measureMotion(const Trajectory& trajectory) {
    const auto& frames = trajectory.frames;
    const double dt = trajectory.frame_interval_s;
    if (dt <= 0.0) return {};
    std::vector<double> speeds, turns, accelerations, turn_accelerations, jerks;
    // Velocities and turning rates since the start of the current path.
    std::vector<Eigen::Vector3d> velocities, rates;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        if (!followsOn(trajectory, i)) {
            velocities.clear();
            rates.clear();
            continue;
        }
        velocities.emplace_back((frames[i].pose.position - frames[i - 1].pose.position) / dt);
        rates.push_back(kDegrees / dt *
                        turnBetween(frames[i - 1].pose.rotation, frames[i].pose.rotation));
        speeds.push_back(velocities.back().norm());
        turns.push_back(rates.back().norm());
        const std::size_t n = velocities.size();
        if (n < 2) continue;
        accelerations.push_back((velocities[n - 1] - velocities[n - 2]).norm() / dt);
        turn_accelerations.push_back((rates[n - 1] - rates[n - 2]).norm() / dt);
        if (n < 3) continue;
        jerks.push_back((velocities[n - 1] - 2.0 * velocities[n - 2] + velocities[n - 3]).norm() /
                        (dt * dt));
    }
    return {spreadOf(std::move(speeds)), spreadOf(std::move(turns)),
            spreadOf(std::move(accelerations)), spreadOf(std::move(turn_accelerations)),
            spreadOf(std::move(jerks))};
}

}  // namespace dollytrack
