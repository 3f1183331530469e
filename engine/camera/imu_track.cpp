#include "engine/camera/imu_track.h"

#include <algorithm>
#include <cmath>

namespace dollytrack {
namespace {

/// Position, then quaternion (x, y, z, w) with signs that make neighbours near.
using Vector7 = Eigen::Matrix<double, 7, 1>;

struct SplinePoint {
    Vector7 value, velocity, acceleration;
};

/// Cubic spline through values at rising times with continuous second derivatives; at both ends
/// one cubic goes through four values ("not a knot"), which assumes nothing about how the motion
/// begins.
class Spline {
  public:
    Spline(std::vector<double> times, std::vector<Vector7> values)
        : times_(std::move(times)), values_(std::move(values)) {
        solve();
    }

    [[nodiscard]] SplinePoint at(double time) const {
        const auto above = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
        const auto i = static_cast<std::size_t>(above - times_.begin()) - 1;
        const double h = times_[i + 1] - times_[i];
        const double b = (time - times_[i]) / h;
        const double a = 1.0 - b;
        const Vector7 slope = (values_[i + 1] - values_[i]) / h;
        return {
            a * values_[i] + b * values_[i + 1] +
                h * h / 6.0 * ((a * a * a - a) * second_[i] + (b * b * b - b) * second_[i + 1]),
            slope +
                h / 6.0 * ((1.0 - 3.0 * a * a) * second_[i] + (3.0 * b * b - 1.0) * second_[i + 1]),
            a * second_[i] + b * second_[i + 1]};
    }

  private:
    void solve();

    std::vector<double> times_;
    std::vector<Vector7> values_;
    std::vector<Vector7> second_;  // derivatives at the times
};

void Spline::solve() {
    const std::size_t n = times_.size();
    second_.assign(n, Vector7::Zero());
    if (n < 3) return;  // a straight line
    const auto width = [&](std::size_t i) { return times_[i + 1] - times_[i]; };
    const auto slope = [&](std::size_t i) -> Vector7 {
        return (values_[i + 1] - values_[i]) / width(i);
    };
    if (n == 3) {  // a parabola
        const Vector7 bend = 2.0 * (slope(1) - slope(0)) / (width(0) + width(1));
        second_.assign(n, bend);
        return;
    }
    // Tridiagonal for the inner ones; the outer follow from them: three derivatives on a line.
    const double first = width(0) / width(1);
    const double last = width(n - 2) / width(n - 3);
    std::vector<double> diagonal(n, 0.0);
    std::vector<double> right(n, 0.0);
    std::vector<Vector7> sum(n, Vector7::Zero());
    for (std::size_t i = 1; i + 1 < n; ++i) {
        double left = width(i - 1);
        diagonal[i] = 2.0 * (width(i - 1) + width(i));
        right[i] = width(i);
        sum[i] = 6.0 * (slope(i) - slope(i - 1));
        if (i == 1) {  // second[0] = (1 + first) second[1] - first second[2]
            diagonal[i] += left * (1.0 + first);
            right[i] -= left * first;
            continue;
        }
        if (i + 2 == n) {  // second[n-1] = (1 + last) second[n-2] - last second[n-3]
            diagonal[i] += right[i] * (1.0 + last);
            left -= right[i] * last;
            right[i] = 0.0;
        }
        const double factor = left / diagonal[i - 1];
        diagonal[i] -= factor * right[i - 1];
        sum[i] -= factor * sum[i - 1];
    }
    for (std::size_t i = n - 2; i > 0; --i) {
        second_[i] = (sum[i] - right[i] * second_[i + 1]) / diagonal[i];
    }
    second_[0] = (1.0 + first) * second_[1] - first * second_[2];
    second_[n - 1] = (1.0 + last) * second_[n - 2] - last * second_[n - 3];
}

Spline splineThrough(const std::vector<TrajectoryFrame>& motion) {
    std::vector<double> times;
    std::vector<Vector7> values;
    for (const TrajectoryFrame& frame : motion) {
        Eigen::Vector4d turned = frame.pose.rotation.coeffs();
        if (!values.empty() && turned.dot(values.back().tail<4>()) < 0.0) turned = -turned;
        Vector7 value;
        value << frame.pose.position, turned;
        times.push_back(frame.time_s);
        values.push_back(value);
    }
    return {std::move(times), std::move(values)};
}

}  // namespace

std::vector<ImuSample> imuTrack(const std::vector<TrajectoryFrame>& motion, double rate_hz) {
    std::vector<ImuSample> samples;
    if (motion.size() < 2 || rate_hz <= 0.0) return samples;
    const Spline spline = splineThrough(motion);
    const double begin = motion.front().time_s;
    const double length = motion.back().time_s - begin;
    const auto count = static_cast<std::size_t>(std::floor(length * rate_hz + 1e-6));
    samples.reserve(count + 1);
    for (std::size_t i = 0; i <= count; ++i) {
        const double time = begin + std::min(length, static_cast<double>(i) / rate_hz);
        const SplinePoint point = spline.at(time);
        const Eigen::Quaterniond q(Eigen::Vector4d(point.value.tail<4>()));
        const Eigen::Quaterniond change(Eigen::Vector4d(point.velocity.tail<4>()));
        const Eigen::Vector3d felt =
            point.acceleration.head<3>() + kGravity_mps2 * Eigen::Vector3d::UnitZ();
        // The spline's quaternions are only nearly unit; the quotient is right for any length.
        samples.push_back({time, 2.0 * (q.conjugate() * change).vec() / q.squaredNorm(),
                           q.normalized().conjugate() * felt});
    }
    return samples;
}

}  // namespace dollytrack
