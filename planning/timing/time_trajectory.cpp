#include "planning/timing/time_trajectory.h"

#include "engine/jobs/parallel.h"
#include "planning/plan_params.h"
#include "planning/timing/clip.h"
#include "planning/timing/heading_keys.h"
#include "planning/timing/key_views.h"
#include "planning/timing/motion_limits.h"
#include "planning/timing/speed_profile.h"
#include "planning/timing/turn.h"
#include "planning/timing/turn_profile.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kMostFrames = 1'000'000;
constexpr std::size_t kGrain = 8;  // segments per task

/// The motion from one key to the next.
struct Segment {
    const SmoothPath::Key* from = nullptr;
    const SmoothPath::Key* to = nullptr;
    Turn turn;
    TurnProfile turn_profile;
    Eigen::Vector3d from_target, to_target;
};

/// A continuous motion along one path.
struct Motion {
    const SmoothPath* path = nullptr;
    std::size_t path_index = 0;
    SpeedProfile speed_profile;
    std::size_t first_segment = 0;
    std::vector<double> least_times_s;   // by segment, from their turns
    std::vector<double> weighted_s;      // by segment: shortest time of a straight move or turn,
                                         // times Key::frame_weight
    std::vector<std::size_t> intervals;  // of the motion, by segment
    std::vector<std::size_t> kept;       // by segment: frames kept after its first key

    [[nodiscard]] std::size_t frames() const {
        return std::accumulate(intervals.begin(), intervals.end(), std::size_t{1});
    }
};

Segment makeSegment(const SmoothPath& path, std::size_t key, const KeyViews& views,
                    const PitchBand& pitch, const MotionLimits& limits) {
    Segment s;
    s.from = &path.keys[key];
    s.to = &path.keys[key + 1];
    s.turn = Turn(views.pose(*s.from).rotation, views.pose(*s.to).rotation, pitch);
    s.turn_profile = TurnProfile(s.turn, limits);
    s.from_target = views.target(*s.from);
    s.to_target = views.target(*s.to);
    return s;
}

TrajectoryFrame frameAtKey(const Motion& motion, const SmoothPath::Key& key,
                           const KeyViews& views) {
    TrajectoryFrame frame;
    frame.path = static_cast<int>(motion.path_index);
    frame.component = motion.path->component;
    frame.pose = views.pose(key);
    frame.target_in_world = views.target(key);
    frame.position_point = key.position_point;
    frame.arc_m = key.arc_m;
    return frame;
}

/// Writes the frames after the segment's first key up to its second, starting at `frames`. The
/// segment begins after `begin` intervals of `interval_s`; `profile_interval_s` is the interval at
/// which the motions meet their limits.
void putFrames(const Motion& motion, std::size_t index, const Segment& s, const KeyViews& views,
               std::size_t begin, double profile_interval_s, double interval_s,
               TrajectoryFrame* frames) {
    const std::size_t count = motion.intervals[index];
    const double time_s = profile_interval_s * static_cast<double>(count);
    const std::vector<double> arcs = motion.speed_profile.arcs(index, time_s, count);
    const double from_distance = (s.from_target - s.from->position).norm();
    const double to_distance = (s.to_target - s.to->position).norm();
    for (std::size_t i = 1; i <= count; ++i) {
        TrajectoryFrame& frame = frames[i - 1];
        if (i == count) frame = frameAtKey(motion, *s.to, views);
        frame.time_s = interval_s * static_cast<double>(begin + i);
        if (i == count) break;
        const double share = static_cast<double>(i) / static_cast<double>(count);
        frame.path = static_cast<int>(motion.path_index);
        frame.component = motion.path->component;
        frame.arc_m = arcs[i - 1];
        // turning on the spot
        frame.pose.position =
            s.to->arc_m <= s.from->arc_m ? s.from->position : motion.path->at(frame.arc_m);
        frame.pose.rotation = s.turn.at(s.turn_profile.turnedAt(share));
        const double distance = (1.0 - share) * from_distance + share * to_distance;
        frame.target_in_world = frame.pose.position + distance * frame.pose.forward();
    }
}

std::size_t settleAll(std::vector<Motion>& motions, double interval_s) {
    std::size_t frames = 0;
    for (Motion& motion : motions) {
        motion.intervals = motion.speed_profile.settle(interval_s, motion.least_times_s);
        frames += motion.frames();
    }
    return frames;
}

/// Finds, by bisection, the shortest frame interval between `low` and `high` that gives at most
/// `most_frames`, and times the motions with it. `low` gives too many frames, `high` does not.
double settleBetween(std::vector<Motion>& motions, double low, double high, std::size_t most_frames,
                     double precision) {
    while (high > low * (1.0 + precision)) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        (settleAll(motions, middle) <= most_frames ? high : low) = middle;
    }
    settleAll(motions, high);
    return high;
}

/// Finds the shortest frame interval, to 0.1 %, that meets the budget, and times the motions with
/// it.
double settleWithin(std::vector<Motion>& motions, double interval_s, std::size_t max_frames,
                    double precision = 0.001) {
    const std::size_t wanted = settleAll(motions, interval_s);
    if (max_frames == 0 || wanted <= max_frames) return interval_s;
    double low = interval_s;
    double high = interval_s * static_cast<double>(wanted) / static_cast<double>(max_frames);
    while (settleAll(motions, high) > max_frames) {
        low = high;
        high *= 1.5;
    }
    return settleBetween(motions, low, high, max_frames, precision);
}

/// Times the motions more slowly than their limits require, so that they take `frames` frames or
/// as close below as possible. Returns the interval that gives as many frames at the limits.
double settleInto(std::vector<Motion>& motions, double interval_s, std::size_t frames) {
    constexpr double kPrecision = 1e-9;
    constexpr int kMostHalvings = 40;  // if the camera never moves, the number of frames does not
                                       // grow
    if (settleAll(motions, interval_s) > frames) {
        return settleWithin(motions, interval_s, frames, kPrecision);
    }
    double high = interval_s;
    for (int i = 0; i < kMostHalvings; ++i) {
        const double low = 0.5 * high;
        if (settleAll(motions, low) > frames) {
            return settleBetween(motions, low, high, frames, kPrecision);
        }
        high = low;
    }
    return high;
}

/// Distributes a budget of frames over the segments, in proportion to their times, or to their
/// weighted times if those are longer: at least one for each segment, and no more than it has
/// intervals.
void keepFrames(std::vector<Motion>& motions, double interval_s, std::size_t most_frames) {
    struct Share {
        std::size_t* kept;
        double weight;
        std::size_t intervals;
        [[nodiscard]] double at(double scale) const {
            return std::clamp(scale * weight, 1.0, static_cast<double>(intervals));
        }
    };
    std::vector<Share> shares;
    double largest = 0.0;  // scale that keeps all frames
    std::size_t all = 0;
    for (Motion& motion : motions) {
        motion.kept = motion.intervals;
        for (std::size_t i = 0; i < motion.kept.size(); ++i) {
            const auto intervals = static_cast<double>(motion.intervals[i]);
            const double weight = std::max(motion.weighted_s[i] / interval_s, intervals);
            shares.push_back({&motion.kept[i], weight, motion.intervals[i]});
            largest = std::max(largest, intervals / weight);
            all += motion.intervals[i];
        }
    }
    const std::size_t budget =
        most_frames - motions.size();  // the first keys have frames of their own
    const auto total = [&](double scale) {
        std::size_t sum = 0;
        for (const Share& share : shares) sum += static_cast<std::size_t>(share.at(scale));
        return sum;
    };
    if (all <= budget) return;
    constexpr int kHalvings = 60;
    double scale = 0.0;
    double step = largest;
    for (int i = 0; i < kHalvings; ++i) {
        step *= 0.5;
        if (total(scale + step) <= budget) scale += step;
    }
    std::size_t left = budget;
    for (const Share& share : shares) {
        *share.kept = static_cast<std::size_t>(share.at(scale));
        left -= *share.kept;
    }
    // The frames left by rounding go to the largest remainders.
    std::ranges::stable_sort(shares, std::greater(), [&](const Share& share) {
        return share.at(scale) - std::floor(share.at(scale));
    });
    for (const Share& share : shares) {
        if (left == 0) break;
        if (*share.kept >= share.intervals) continue;
        ++*share.kept;
        --left;
    }
}

/// Repeats the last frame until there are so many frames.
void standStill(Trajectory& trajectory, std::size_t frames) {
    if (trajectory.frames.empty()) return;
    TrajectoryFrame last = trajectory.frames.back();
    last.position_point = -1;
    while (trajectory.frames.size() < frames) {
        last.time_s = trajectory.frame_interval_s * static_cast<double>(trajectory.frames.size());
        trajectory.frames.push_back(last);
    }
}

std::vector<SmoothPath> turnedAlong(const std::vector<SmoothPath>& paths, const KeyViews& views,
                                    const HeadingLimit& heading) {
    std::vector<SmoothPath> turned;
    for (const SmoothPath& path : paths) {
        turned.push_back(withHeadingKeys(
            path, [&](const SmoothPath::Key& key) { return views.pose(key); }, heading));
    }
    return turned;
}

}  // namespace

Result<Trajectory> timeTrajectory(const std::vector<SmoothPath>& smooth_paths,
                                  const std::vector<PositionPoint>& position_points,
                                  const std::vector<ObservationPoint>& observation_points,
                                  const TimingParams& params, const PitchBand& pitch,
                                  const HeadingLimit& heading) {
    const MotionLimits limits = motionLimits(params);
    const KeyViews views(position_points, observation_points, pitch);
    const std::vector<SmoothPath> paths = turnedAlong(smooth_paths, views, heading);
    std::vector<Motion> motions;
    std::vector<std::pair<std::size_t, std::size_t>> begins;  // of segments: motion and key
    for (std::size_t p = 0; p < paths.size(); ++p) {
        if (paths[p].keys.empty()) continue;
        const std::size_t first = begins.size();
        for (std::size_t k = 0; k + 1 < paths[p].keys.size(); ++k) {
            begins.emplace_back(motions.size(), k);
        }
        motions.push_back({&paths[p], p, SpeedProfile(paths[p], limits), first, {}, {}, {}, {}});
    }
    if (params.max_frames > 0 && !keepsFrameRate(params) &&
        begins.size() + motions.size() > static_cast<std::size_t>(params.max_frames)) {
        return fail(ErrorCode::Failed,
                    heading.restricts()
                        ? "There are more key frames and turns on the spot than max_frames allows; "
                          "raise it."
                        : "There are more key frames than max_frames allows.",
                    "max_frames");
    }
    std::vector<Segment> segments(begins.size());
    parallelRanges(begins.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto [motion, key] = begins[i];
            segments[i] = makeSegment(*motions[motion].path, key, views, pitch, limits);
        }
    });
    const double motion_rps = imageMotionLimit_rps(params);
    for (std::size_t i = 0; i < begins.size(); ++i) {
        double least_s = segments[i].turn_profile.time();
        if (motion_rps > 0.0) {
            least_s = std::max(least_s, segments[i].to->image_motion_rad / motion_rps);
        }
        Motion& motion = motions[begins[i].first];
        motion.least_times_s.push_back(least_s);
        const SmoothPath::Key& to = *segments[i].to;
        const double travel_s = (to.arc_m - segments[i].from->arc_m) / limits.speed_mps;
        motion.weighted_s.push_back(to.frame_weight *
                                    std::max(segments[i].turn_profile.time(), travel_s));
    }
    Trajectory trajectory;
    const double interval_s = 1.0 / params.frame_rate;
    const bool whole_clip = params.duration_s > 0.0;
    const bool has_budget = params.max_frames > 0 && !keepsFrameRate(params);
    // Frame interval with motion at its limits; in a clip of given duration the motion is slower.
    double settled_s = whole_clip ? settleInto(motions, interval_s, clipFrames(params))
                                  : (settleAll(motions, interval_s), interval_s);
    const auto framesOfAll = [&] {
        std::size_t frames = 0;
        for (const Motion& motion : motions) frames += motion.frames();
        return frames;
    };
    if (framesOfAll() > kMostFrames) {
        if (!has_budget) {
            return fail(ErrorCode::Usage,
                        "At these limits the trajectory would have more than a million frames; "
                        "lower frame_rate, raise max_speed_mps or max_turn_dps, or set max_frames.",
                        "frame_rate");
        }
        settled_s = settleWithin(motions, interval_s, kMostFrames);
    }
    trajectory.frame_interval_s = keepsFrameRate(params) ? interval_s : settled_s;
    if (has_budget) {
        keepFrames(motions, settled_s, params.max_frames);
    } else {
        for (Motion& motion : motions) motion.kept = motion.intervals;
    }
    std::vector<TrajectoryFrame>& all = trajectory.frames;
    std::vector<char> keep;                 // by frame
    std::vector<std::size_t> first_frames;  // by segment, after its first key
    for (const Motion& motion : motions) {
        all.push_back(frameAtKey(motion, motion.path->keys.front(), views));
        all.back().time_s = trajectory.frame_interval_s * static_cast<double>(all.size() - 1);
        keep.push_back(1);
        for (std::size_t i = 0; i < motion.kept.size(); ++i) {
            first_frames.push_back(all.size());
            all.resize(all.size() + motion.intervals[i]);
            keep.resize(all.size(), 0);
            for (std::size_t k = 1; k <= motion.kept[i]; ++k) {  // evenly spread
                keep[first_frames.back() - 1 + k * motion.intervals[i] / motion.kept[i]] = 1;
            }
        }
    }
    parallelRanges(segments.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
            const Motion& motion = motions[begins[s].first];
            putFrames(motion, s - motion.first_segment, segments[s], views, first_frames[s] - 1,
                      settled_s, trajectory.frame_interval_s, &all[first_frames[s]]);
        }
    });
    if (has_budget) trajectory = keepOnly(trajectory, keep);
    if (whole_clip) standStill(trajectory, clipFrames(params));
    return trajectory;
}

}  // namespace dollytrack::planning
