#include "engine/camera/trajectory.h"

#include "engine/math/quantile.h"

#include <utility>

namespace dollytrack {

double durationOf(const Trajectory& trajectory) {
    if (trajectory.frames.empty()) return 0.0;
    return trajectory.frames.back().time_s - trajectory.frames.front().time_s +
           trajectory.frame_interval_s;
}

std::optional<double> medianStep_s(const std::vector<TrajectoryFrame>& frames) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        if (frames[i].path != frames[i - 1].path) continue;
        steps.push_back(frames[i].time_s - frames[i - 1].time_s);
    }
    if (steps.empty()) return std::nullopt;
    return upperMedian(std::move(steps));
}

std::vector<std::size_t> motionOrder(const Trajectory& trajectory) {
    const std::vector<TrajectoryFrame>& frames = trajectory.frames;
    const std::vector<TrajectoryFrame>& left_out = trajectory.left_out;
    std::vector<std::size_t> order;
    order.reserve(frames.size() + left_out.size());
    std::size_t next = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        for (; next < left_out.size() && left_out[next].time_s < frames[i].time_s; ++next) {
            order.push_back(frames.size() + next);
        }
        order.push_back(i);
    }
    for (; next < left_out.size(); ++next) order.push_back(frames.size() + next);
    return order;
}

const TrajectoryFrame& motionFrame(const Trajectory& trajectory, std::size_t index) {
    const std::size_t kept = trajectory.frames.size();
    return index < kept ? trajectory.frames[index] : trajectory.left_out[index - kept];
}

std::vector<TrajectoryFrame> motionFrames(const Trajectory& trajectory) {
    std::vector<TrajectoryFrame> frames;
    for (const std::size_t i : motionOrder(trajectory)) {
        frames.push_back(motionFrame(trajectory, i));
    }
    return frames;
}

Trajectory keepOnly(const Trajectory& trajectory, const std::vector<char>& keep) {
    Trajectory result{trajectory.frame_interval_s, {}};
    for (const std::size_t i : motionOrder(trajectory)) {
        const bool kept = i < keep.size() && keep[i] != 0;
        (kept ? result.frames : result.left_out).push_back(motionFrame(trajectory, i));
    }
    return result;
}

}  // namespace dollytrack
