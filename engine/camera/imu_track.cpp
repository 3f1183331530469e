#include "engine/camera/imu_track.h"

#include "engine/camera/pose_spline.h"

#include <algorithm>
#include <cmath>

namespace dollytrack {

std::vector<ImuSample> imuTrack(const std::vector<TrajectoryFrame>& motion, double rate_hz) {
    std::vector<ImuSample> samples;
    if (motion.size() < 2 || rate_hz <= 0.0) return samples;
    const PoseSpline spline(motion);
    const double begin = motion.front().time_s;
    const double length = motion.back().time_s - begin;
    const auto count = static_cast<std::size_t>(std::floor(length * rate_hz + 1e-6));
    samples.reserve(count + 1);
    for (std::size_t i = 0; i <= count; ++i) {
        const double time = begin + std::min(length, static_cast<double>(i) / rate_hz);
        const PoseSpline::Point point = spline.at(time);
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
