#include "engine/camera/pose_spline.h"

#include <algorithm>

namespace dollytrack {

PoseSpline::PoseSpline(std::span<const TrajectoryFrame> motion) {
    for (const TrajectoryFrame& frame : motion) {
        Eigen::Vector4d turned = frame.pose.rotation.coeffs();
        if (!values_.empty() && turned.dot(values_.back().tail<4>()) < 0.0) turned = -turned;
        Vector7 value;
        value << frame.pose.position, turned;
        times_.push_back(frame.time_s);
        values_.push_back(value);
    }
    solve();
}

PoseSpline::Point PoseSpline::at(double time) const {
    const auto above = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
    const auto i = static_cast<std::size_t>(above - times_.begin()) - 1;
    const double h = times_[i + 1] - times_[i];
    const double b = (time - times_[i]) / h;
    const double a = 1.0 - b;
    const Vector7 slope = (values_[i + 1] - values_[i]) / h;
    return {
        a * values_[i] + b * values_[i + 1] +
            h * h / 6.0 * ((a * a * a - a) * second_[i] + (b * b * b - b) * second_[i + 1]),
        slope + h / 6.0 * ((1.0 - 3.0 * a * a) * second_[i] + (3.0 * b * b - 1.0) * second_[i + 1]),
        a * second_[i] + b * second_[i + 1]};
}

void PoseSpline::solve() {
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
    // A tridiagonal system for the inner knots. The outer second derivatives follow from them:
    // not-a-knot end conditions.
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

}  // namespace dollytrack
