#include "engine/camera/imu_track.h"

#include <algorithm>
#include <cmath>

namespace dollytrack {

std::vector<ImuSample> imuTrack(const PoseSpline& path, double rate_hz, double from_s,
                                double to_s) {
    std::vector<ImuSample> samples;
    if (rate_hz <= 0.0) return samples;
    constexpr double kRounding = 1e-6;  // share of a sample's interval
    const double length = path.end() - path.begin();
    const auto intervals = [&](double time_s) { return (time_s - path.begin()) * rate_hz; };
    const double first = std::max(std::floor(intervals(from_s) + kRounding), 0.0);
    const double last = std::min(std::ceil(intervals(to_s) - kRounding),
                                 std::floor(intervals(path.end()) + kRounding));
    for (double i = first; i <= last; i += 1.0) {
        const double time = path.begin() + std::min(length, i / rate_hz);
        const PoseSpline::Point point = path.at(time);
        const Eigen::Quaterniond q(Eigen::Vector4d(point.value.tail<4>()));
        const Eigen::Quaterniond change(Eigen::Vector4d(point.velocity.tail<4>()));
        const Eigen::Vector3d felt =
            point.acceleration.head<3>() + kGravity_mps2 * Eigen::Vector3d::UnitZ();
        // The spline's quaternions are only approximately unit; dividing by the squared norm
        // corrects for it.
        samples.push_back({time, 2.0 * (q.conjugate() * change).vec() / q.squaredNorm(),
                           q.normalized().conjugate() * felt});
    }
    return samples;
}

}  // namespace dollytrack
