#include "engine/camera/camera_motion.h"

#include <algorithm>
#include <span>

namespace dollytrack {

CameraMotion::CameraMotion(const Trajectory& trajectory) {
    const std::vector<std::size_t> order = motionOrder(trajectory);
    const std::vector<TrajectoryFrame> all = motionFrames(trajectory);
    for (std::size_t begin = 0; begin < all.size();) {
        std::size_t end = begin + 1;
        while (end < all.size() && all[end].path == all[begin].path &&
               all[end].time_s > all[end - 1].time_s) {
            ++end;
        }
        const bool moves = end - begin > 1;
        if (moves) paths_.emplace_back(std::span(all).subspan(begin, end - begin));
        for (; begin < end; ++begin) {
            if (order[begin] >= trajectory.frames.size()) continue;
            frames_.push_back({all[begin], moves ? static_cast<int>(paths_.size()) - 1 : -1});
        }
    }
}

const PoseSpline* CameraMotion::pathOf(std::size_t frame) const {
    const int path = frames_[frame].path;
    return path < 0 ? nullptr : &paths_[path];
}

Pose CameraMotion::poseAt(std::size_t frame, double after_s) const {
    const Frame& from = frames_[frame];
    if (from.path < 0 || after_s == 0.0) return from.given.pose;
    const PoseSpline& path = paths_[from.path];
    const double time = from.given.time_s + after_s;
    const double within = std::clamp(time, path.begin(), path.end());
    const PoseSpline::Point point = path.at(within);
    const PoseSpline::Vector7 value = point.value + (time - within) * point.velocity;
    return {value.head<3>(), Eigen::Quaterniond(Eigen::Vector4d(value.tail<4>())).normalized()};
}

}  // namespace dollytrack
