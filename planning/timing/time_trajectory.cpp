#include "planning/timing/time_trajectory.h"

#include "engine/jobs/parallel.h"
#include "planning/plan_params.h"
#include "planning/timing/turn.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace dollytrack::planning {
namespace {

constexpr std::int64_t kMostFrames = 1'000'000;
constexpr std::size_t kGrain = 8;  // stretches a thread takes at once

/// The motion from one key frame to the next.
struct Stretch {
    const SmoothPath* path = nullptr;
    std::size_t path_index = 0;
    const SmoothPath::Key* from = nullptr;
    const SmoothPath::Key* to = nullptr;
    Turn turn;
    Eigen::Vector3d from_target, to_target;
    double least_time_s = 0.0;  // by the limits

    [[nodiscard]] std::int64_t frames(double interval) const {
        return std::max<std::int64_t>(
            1, static_cast<std::int64_t>(std::ceil(least_time_s / interval - 1e-9)));
    }
};

class Timer {
  public:
    Timer(const std::vector<PositionPoint>& points, const std::vector<ObservationPoint>& targets,
          const TimingParams& params)
        : points_(points), targets_(targets), params_(params) {}

    [[nodiscard]] Stretch stretch(const SmoothPath& path, std::size_t path_index,
                                  std::size_t key) const {
        Stretch s;
        s.path = &path;
        s.path_index = path_index;
        s.from = &path.keys[key];
        s.to = &path.keys[key + 1];
        s.from_target = target(*s.from);
        s.to_target = target(*s.to);
        s.turn = Turn(rotation(*s.from), rotation(*s.to));
        const double turn_limit = params_.max_turn_dps * std::numbers::pi / 180.0;
        s.least_time_s = std::max((s.to->arc_m - s.from->arc_m) / params_.max_speed_mps,
                                  s.turn.greatestRate() / turn_limit);
        return s;
    }

    [[nodiscard]] TrajectoryFrame frame(const Stretch& s, double share) const {
        TrajectoryFrame frame;
        frame.path = static_cast<int>(s.path_index);
        frame.component = s.path->component;
        frame.pose.position =
            share >= 1.0 ? s.to->position
            : s.to->arc_m <= s.from->arc_m
                ? s.from->position  // two keys at one place
                : s.path->at(s.from->arc_m + share * (s.to->arc_m - s.from->arc_m));
        frame.pose.rotation = s.turn.at(share);
        const double distance = (1.0 - share) * (s.from_target - s.from->position).norm() +
                                share * (s.to_target - s.to->position).norm();
        frame.target_in_world = frame.pose.position + distance * frame.pose.forward();
        if (share >= 1.0) frame.position_point = s.to->position_point;
        return frame;
    }

    [[nodiscard]] TrajectoryFrame first(const SmoothPath& path, std::size_t path_index) const {
        const SmoothPath::Key& key = path.keys.front();
        TrajectoryFrame frame;
        frame.path = static_cast<int>(path_index);
        frame.component = path.component;
        frame.pose = {key.position, rotation(key)};
        frame.target_in_world = target(key);
        frame.position_point = key.position_point;
        return frame;
    }

  private:
    [[nodiscard]] const PositionPoint& point(const SmoothPath::Key& key) const {
        return points_[static_cast<std::size_t>(key.position_point)];
    }

    /// What the camera looks at there. From a pinned point it looks where it was told to, as far as
    /// its target is away.
    [[nodiscard]] Eigen::Vector3d target(const SmoothPath::Key& key) const {
        const PositionPoint& p = point(key);
        const auto& target = targets_[static_cast<std::size_t>(p.observation_point)].position;
        if (p.pin < 0) return target;
        constexpr double kNearest_m = 0.1;
        const double distance = std::max(kNearest_m, (target - p.pose.position).norm());
        return p.pose.position + distance * p.pose.forward();
    }

    [[nodiscard]] Eigen::Quaterniond rotation(const SmoothPath::Key& key) const {
        // Smoothing moves other keys a little, and they turn to keep their target in the middle.
        return point(key).pin >= 0 ? point(key).pose.rotation
                                   : lookAt(key.position, target(key)).rotation;
    }

    const std::vector<PositionPoint>& points_;
    const std::vector<ObservationPoint>& targets_;
    const TimingParams& params_;
};

std::int64_t countFrames(const std::vector<Stretch>& stretches, std::size_t path_count,
                         double interval) {
    auto count = static_cast<std::int64_t>(path_count);
    for (const Stretch& s : stretches) count += s.frames(interval);
    return count;
}

/// The shortest frame interval that keeps to the budget, found to 0.1 %.
double intervalWithin(const std::vector<Stretch>& stretches, std::size_t path_count,
                      double interval, int max_frames) {
    if (countFrames(stretches, path_count, interval) <= max_frames) return interval;
    double low = interval;
    double high = interval;
    for (const Stretch& s : stretches) high = std::max(high, s.least_time_s);
    while (high > low * 1.001) {
        const double middle = 0.5 * (low + high);
        (countFrames(stretches, path_count, middle) <= max_frames ? high : low) = middle;
    }
    return high;
}

}  // namespace

Result<Trajectory> timeTrajectory(const std::vector<SmoothPath>& paths,
                                  const std::vector<PositionPoint>& position_points,
                                  const std::vector<ObservationPoint>& observation_points,
                                  const TimingParams& params) {
    const Timer timer(position_points, observation_points, params);
    std::vector<std::pair<std::size_t, std::size_t>> begins;  // of stretches: path and key
    std::size_t keyed_paths = 0;
    for (std::size_t p = 0; p < paths.size(); ++p) {
        keyed_paths += paths[p].keys.empty() ? 0 : 1;
        for (std::size_t k = 0; k + 1 < paths[p].keys.size(); ++k) begins.emplace_back(p, k);
    }
    std::vector<Stretch> stretches(begins.size());
    parallelRanges(begins.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto [p, k] = begins[i];
            stretches[i] = timer.stretch(paths[p], p, k);
        }
    });
    Trajectory trajectory;
    trajectory.frame_interval_s = 1.0 / params.frame_rate;
    if (params.max_frames > 0) {
        if (static_cast<int>(stretches.size() + keyed_paths) > params.max_frames) {
            return fail(ErrorCode::Failed, "There are more key frames than max_frames allows.",
                        "max_frames");
        }
        trajectory.frame_interval_s =
            intervalWithin(stretches, keyed_paths, trajectory.frame_interval_s, params.max_frames);
    }
    const std::int64_t total = countFrames(stretches, keyed_paths, trajectory.frame_interval_s);
    if (total > kMostFrames) {
        return fail(ErrorCode::Usage,
                    "At these limits the trajectory would have more than a million frames; lower "
                    "frame_rate, raise max_speed_mps or max_turn_dps, or set max_frames.",
                    "frame_rate");
    }
    std::vector<std::size_t> first_frames;  // of each stretch
    std::size_t frames = 0;
    std::size_t stretch = 0;
    trajectory.frames.resize(static_cast<std::size_t>(total));
    for (std::size_t p = 0; p < paths.size(); ++p) {
        if (paths[p].keys.empty()) continue;
        trajectory.frames[frames++] = timer.first(paths[p], p);
        for (; stretch < stretches.size() && stretches[stretch].path_index == p; ++stretch) {
            first_frames.push_back(frames);
            frames +=
                static_cast<std::size_t>(stretches[stretch].frames(trajectory.frame_interval_s));
        }
    }
    parallelRanges(stretches.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
            const std::int64_t count = stretches[s].frames(trajectory.frame_interval_s);
            for (std::int64_t i = 1; i <= count; ++i) {
                trajectory.frames[first_frames[s] + static_cast<std::size_t>(i - 1)] =
                    timer.frame(stretches[s], static_cast<double>(i) / static_cast<double>(count));
            }
        }
    });
    for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
        trajectory.frames[i].time_s = static_cast<double>(i) * trajectory.frame_interval_s;
    }
    return trajectory;
}

}  // namespace dollytrack::planning
