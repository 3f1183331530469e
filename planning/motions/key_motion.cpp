#include "planning/motions/key_motion.h"

#include "planning/collision/swept_sphere.h"
#include "planning/motions/key_curve.h"
#include "planning/motions/motion_check.h"
#include "planning/motions/time_path.h"
#include "planning/plan_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace dollytrack::planning {
namespace {

using Eigen::Vector3d;

// A segment is lengthened by at most 10 % a round, because its neighbours may cause the excess.
constexpr double kLargestStep = 1.1;
// Upper bound of a segment's frames; above kMostMotionFrames, so that place() refuses it.
constexpr double kMostFrames = 1e6;
// From this round on all segments are slowed down together, which ends the search.
constexpr int kRoundsBySegment = 100;
constexpr int kMostRounds = 200;
// A key is reached if the camera is at most this far from it, m.
constexpr double kReached_m = 1e-3;

/// Sampled motion through keys that are at whole frames.
class KeyFrames {
  public:
    KeyFrames(std::span<const MotionKey> keys, double interval_s,
              std::size_t most_frames = kMostMotionFrames)
        : keys_(keys),
          interval_s_(interval_s),
          most_frames_(most_frames),
          curve_(keys),
          least_(keys.size(), 1) {}

    /// Finds frames for the keys within the limits. Errors: BadInput, Cancelled.
    Status settle(const MotionLimits& limits, const JobContext& job) {
        setShortest(limits);
        for (int round = 0; round < kMostRounds; ++round) {
            if (job.cancelled()) {
                return fail(ErrorCode::Cancelled, "Timing the key frames was cancelled.");
            }
            if (!place()) {
                return fail(ErrorCode::BadInput,
                            fmt::format("The camera path through the keys would have more than {} "
                                        "frames; give its keys earlier times or nearer positions, "
                                        "or raise the motion limits.",
                                        most_frames_));
            }
            sample();
            std::vector<double> over = excess(limits);
            const double most = *std::ranges::max_element(over);
            if (most <= kLimitTolerance) return {};
            for (std::size_t i = 1; i < keys_.size(); ++i) {
                const double factor =
                    round < kRoundsBySegment ? std::min(over[i], kLargestStep) : most;
                if (factor <= kLimitTolerance) continue;
                const auto longer = static_cast<double>(duration(i)) * factor;
                least_[i] = std::max(duration(i) + 1, static_cast<std::int64_t>(longer));
            }
        }
        return {};
    }

    /// The frame of each key.
    [[nodiscard]] const std::vector<std::int64_t>& frames() const { return frames_; }
    [[nodiscard]] double timeOf(std::int64_t frame) const {
        return keys_.front().time_s + static_cast<double>(frame) * interval_s_;
    }

    [[nodiscard]] Trajectory trajectory() const {
        Trajectory made{interval_s_, {}};
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            TrajectoryFrame frame;
            frame.time_s = timeOf(static_cast<std::int64_t>(i));
            frame.pose = poses_[i];
            frame.target_in_world = frame.pose.position + frame.pose.forward();
            made.frames.push_back(frame);
        }
        return made;
    }

  private:
    [[nodiscard]] std::int64_t duration(std::size_t i) const { return frames_[i] - frames_[i - 1]; }

    /// Gives each segment the frames that it needs at the largest speed and turn rate.
    void setShortest(const MotionLimits& limits) {
        for (std::size_t i = 1; i < keys_.size(); ++i) {
            const double least_s = std::max(curve_.length_m(i - 1) / limits.speed_mps,
                                            curve_.turn_rad(i - 1) / limits.turn_rps);
            const double frames = std::ceil(least_s / (kLimitTolerance * interval_s_));
            least_[i] = static_cast<std::int64_t>(std::clamp(frames, 1.0, kMostFrames));
        }
        shortest_ = least_;
    }

    /// Whether the segment before key i, an inner one, has more time than the one after it,
    /// compared with what they need at least.
    [[nodiscard]] bool isSlower(std::size_t i) const {
        return duration(i) * shortest_[i + 1] > duration(i + 1) * shortest_[i];
    }

    /// Places each key in the frame nearest to its time, or as early as the least durations of the
    /// segments allow. Returns false if there would be too many frames.
    bool place() {
        frames_.assign(keys_.size(), 0);
        for (std::size_t i = 1; i < keys_.size(); ++i) {
            const double wanted = (keys_[i].time_s - keys_[0].time_s) / interval_s_;
            if (!(wanted < static_cast<double>(most_frames_))) return false;
            frames_[i] = std::max<std::int64_t>(std::llround(wanted), frames_[i - 1] + least_[i]);
            if (frames_[i] >= static_cast<std::int64_t>(most_frames_)) return false;
        }
        return true;
    }

    void sample() {
        std::vector<double> times;
        for (const std::int64_t frame : frames_) times.push_back(timeOf(frame));
        curve_.setTimes(std::move(times));
        poses_.assign(1, keys_.front().pose);
        for (std::size_t i = 1; i < keys_.size(); ++i) {
            for (std::int64_t k = frames_[i - 1] + 1; k < frames_[i]; ++k) {
                poses_.push_back(curve_.at(i - 1, timeOf(k)));
            }
            poses_.push_back(keys_[i].pose);
        }
    }

    /// By key: the factor by which the segment before it is too short. Accelerations at a key are
    /// due to the side with less time to spare. Before the first and after the last frame the
    /// camera rests.
    [[nodiscard]] std::vector<double> excess(const MotionLimits& limits) const {
        std::vector<double> over(keys_.size(), 0.0);
        const double dt = interval_s_;
        Vector3d velocity = Vector3d::Zero();
        Vector3d turning = Vector3d::Zero();
        std::size_t segment = 1;
        const auto count = [&](std::size_t i, double factor) {
            if (i > 0 && i < over.size()) over[i] = std::max(over[i], factor);
        };
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            const bool last = i + 1 == poses_.size();
            const bool at_key = static_cast<std::int64_t>(i) == frames_[segment - 1];
            const Vector3d next_velocity =
                last ? Vector3d::Zero()
                     : Vector3d((poses_[i + 1].position - poses_[i].position) / dt);
            const Vector3d next_turning =
                last ? Vector3d::Zero()
                     : Vector3d(rotationVector(poses_[i].rotation, poses_[i + 1].rotation) / dt);
            const double speed = std::max(next_velocity.norm() / limits.speed_mps,
                                          next_turning.norm() / limits.turn_rps);
            const double change =
                std::max((next_velocity - velocity).norm() / dt / limits.acceleration_mps2,
                         (next_turning - turning).norm() / dt / limits.turn_acceleration_rps2);
            count(segment, speed);
            const bool due_to_before = at_key && segment > 1 && !isSlower(segment - 1);
            count(due_to_before ? segment - 1 : segment, std::sqrt(change));
            velocity = next_velocity;
            turning = next_turning;
            if (!last && static_cast<std::int64_t>(i + 1) == frames_[segment] &&
                segment + 1 < frames_.size()) {
                ++segment;
            }
        }
        return over;
    }

    std::span<const MotionKey> keys_;
    double interval_s_;
    std::size_t most_frames_;
    KeyCurve curve_;
    std::vector<std::int64_t> least_;     // by key: fewest frames since the key before it
    std::vector<std::int64_t> shortest_;  // the same from speed and turn rate alone
    std::vector<std::int64_t> frames_;    // by key
    std::vector<Pose> poses_;             // by frame
};

/// Makes the notes of the keys along a repaired motion.
class KeyNotes {
  public:
    KeyNotes(const MappedScene& scene, const std::vector<MotionKey>& keys,
             const RepairedMotion& motion, double interval_s)
        : scene_(scene), check_(scene), keys_(keys), motion_(motion), interval_s_(interval_s) {}

    /// `given_frames` are those of the keys before the repair. Incomplete if cancelled.
    [[nodiscard]] std::vector<PassedKey> passed(const std::vector<std::int64_t>& given_frames,
                                                const JobContext& job) const {
        std::vector<PassedKey> passed;
        double late_s = 0.0;  // of the key before; rounding to a frame may make a key early
        for (std::size_t i = 0; i < keys_.size() && !job.cancelled(); ++i) {
            PassedKey key;
            key.frame = frameOf(static_cast<double>(given_frames[i]));
            const TrajectoryFrame& frame = frames()[static_cast<std::size_t>(key.frame)];
            key.time_s = frame.time_s;
            const double now_late_s = std::max(0.0, frame.time_s - keys_[i].time_s);
            const bool later = isLate(now_late_s - late_s, interval_s_);
            late_s = now_late_s;
            if (!check_.isFree(keys_[i].pose.position)) {
                key.note = collisionNote(i, frame);
            } else if (!isReached(i, given_frames[i], key.frame)) {
                key.note = fmt::format(
                    "Key {} is not reached: the camera passes at a distance of {:.3f} m; move it.",
                    i + 1, distance_m(i, frame));
            } else if (i > 0 && frame.path != frames()[passed[i - 1].frame].path) {
                key.note = fmt::format(
                    "No collision-free path leads from key {} to key {}; remove one of them, or "
                    "add keys that lead around the obstacle.",
                    i, i + 1);
            }
            if (later && key.note.empty()) {
                key.note = lateNote(i, frame.time_s);
            } else if (later) {
                key.note += fmt::format(" It is passed {:.2f} s late.", now_late_s);
            }
            passed.push_back(std::move(key));
        }
        return passed;
    }

  private:
    [[nodiscard]] const std::vector<TrajectoryFrame>& frames() const {
        return motion_.trajectory.frames;
    }

    /// The frame nearest to a given one.
    [[nodiscard]] int frameOf(double given) const {
        const auto& all = motion_.given_frames;
        const auto nearest = std::ranges::min_element(
            all, {}, [&](double frame) { return std::abs(frame - given); });
        return static_cast<int>(nearest - all.begin());
    }

    [[nodiscard]] double distance_m(std::size_t i, const TrajectoryFrame& frame) const {
        return (frame.pose.position - keys_[i].pose.position).norm();
    }

    /// Whether the camera passes key i, given in frame `given`, at its nearest frame or, where the
    /// frames of a retimed stretch stand for other moments, between it and its neighbours.
    [[nodiscard]] bool isReached(std::size_t i, std::int64_t given, int nearest) const {
        const auto k = static_cast<std::size_t>(nearest);
        const TrajectoryFrame& frame = frames()[k];
        double most_m = kReached_m;
        const auto allowMoveTo = [&](const TrajectoryFrame& next) {
            if (next.path != frame.path) return;
            const double move_m = (next.pose.position - frame.pose.position).norm();
            most_m = std::max(most_m, move_m);
        };
        if (motion_.given_frames[k] != static_cast<double>(given)) {
            if (k > 0) allowMoveTo(frames()[k - 1]);
            if (k + 1 < frames().size()) allowMoveTo(frames()[k + 1]);
        }
        return distance_m(i, frame) <= most_m;
    }

    [[nodiscard]] std::string lateNote(std::size_t i, double time_s) const {
        return fmt::format(
            "Key {} is reached at {:.2f} s instead of {:.2f} s; move it later, use 'Set reachable "
            "times', or raise the motion limits (motion_preset).",
            i + 1, time_s, keys_[i].time_s);
    }

    [[nodiscard]] std::string collisionNote(std::size_t i, const TrajectoryFrame& frame) const {
        const double away_m = distance_m(i, frame);
        int object_id = 0;
        const Verdict verdict = scene_.sphere->verdict(keys_[i].pose.position, object_id);
        const bool collides = verdict != Verdict::NoGo && verdict != Verdict::HeightBand &&
                              verdict != Verdict::OutsideRoom;
        std::string note = fmt::format("Key {} {}: the camera ", i + 1,
                                       whyNotFree(scene_, keys_[i].pose.position));
        note += away_m > 0.0 ? fmt::format("passes at a distance of {:.2f} m", away_m)
                : collides   ? "collides there"
                             : "passes there";
        note += "; move the key";
        if (const auto free_place = nearestFree(scene_, keys_[i].pose.position)) {
            note += fmt::format(", for example to {:.2f}, {:.2f}, {:.2f} m", free_place->x(),
                                free_place->y(), free_place->z());
        }
        return note + ".";
    }

    const MappedScene& scene_;
    MotionCheck check_;
    const std::vector<MotionKey>& keys_;
    const RepairedMotion& motion_;
    double interval_s_;
};

}  // namespace

Result<std::vector<double>> keyTimes(std::span<const MotionKey> keys, const MotionLimits& limits,
                                     double interval_s, const JobContext& job,
                                     std::size_t most_frames) {
    KeyFrames frames(keys, interval_s, most_frames);
    if (Status status = frames.settle(limits, job); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    std::vector<double> times;
    for (const std::int64_t frame : frames.frames()) times.push_back(frames.timeOf(frame));
    return times;
}

Result<KeyMotion> moveThroughKeys(const MappedScene& scene, const TimingParams& timing,
                                  const std::vector<MotionKey>& keys, const JobContext& job) {
    PathTiming of_path;
    of_path.limits = motionLimits(timing);
    of_path.frame_interval_s = of_path.smooth_over_s = 1.0 / timing.frame_rate;
    const double interval_s = of_path.frame_interval_s;
    // A detour around an obstacle takes longer than the given motion through it. Each round gives
    // keys that a detour makes late an earlier time, so that the camera goes faster where the
    // limits allow, and reaches them at their own times.
    constexpr int kMostRounds = 4;
    std::vector<MotionKey> hurried = keys;
    KeyMotion best;
    double least_late_s = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kMostRounds; ++round) {
        KeyFrames frames(hurried, interval_s);
        if (Status status = frames.settle(of_path.limits, job); !status) {
            return tl::unexpected(std::move(status.error()));
        }
        // If no free space is near, the notes of the colliding keys say so.
        const auto repaired = repairAndTime(
            scene, of_path, frames.trajectory(),
            job.stage(0.9 * round / kMostRounds, 0.9 * (round + 1) / kMostRounds, "key frames"),
            FarPath::Keep);
        if (!repaired) return tl::unexpected(repaired.error());
        const KeyNotes notes(scene, keys, *repaired, interval_s);
        KeyMotion made{repaired->trajectory, notes.passed(frames.frames(), job)};
        if (job.cancelled()) {
            return fail(ErrorCode::Cancelled, "Planning through the key frames was cancelled.");
        }
        double late_s = 0.0;
        bool detours = false;
        for (std::size_t i = 1; i < keys.size(); ++i) {
            const double here_s = made.passed[i].time_s - keys[i].time_s;
            const double detour_s = made.passed[i].time_s - frames.timeOf(frames.frames()[i]);
            late_s += std::max(0.0, here_s);
            if (isLate(here_s, interval_s) && isLate(detour_s, interval_s)) {
                detours = true;
                hurried[i].time_s -= here_s;
            }
            hurried[i].time_s =
                std::max(hurried[i].time_s, hurried[i - 1].time_s + 0.5 * interval_s);
        }
        if (late_s < least_late_s - 0.5 * interval_s) {
            least_late_s = late_s;
            best = std::move(made);
        } else {
            break;
        }
        if (!detours) break;
    }
    return best;
}

Result<std::vector<MotionKey>> withReachableTimes(const MappedScene& scene,
                                                  const TimingParams& timing,
                                                  std::vector<MotionKey> keys,
                                                  const JobContext& job) {
    // Later times change the motion, and with it the way around obstacles. Two rounds usually
    // suffice.
    constexpr int kMostRounds = 10;
    const double interval_s = 1.0 / timing.frame_rate;
    for (int round = 0; round < kMostRounds; ++round) {
        const auto made =
            moveThroughKeys(scene, timing, keys,
                            job.stage(static_cast<double>(round) / kMostRounds,
                                      static_cast<double>(round + 1) / kMostRounds, "key times"));
        if (!made) return tl::unexpected(made.error());
        bool late = false;
        for (std::size_t i = 0; i < keys.size(); ++i) {
            late = late || isLate(made->passed[i].time_s - keys[i].time_s, interval_s);
        }
        if (!late) break;
        std::vector<MotionKey> reached = withReachedTimes(keys, made->passed, interval_s);
        for (std::size_t i = 0; i < keys.size(); ++i) {
            // Keys that are reached in time keep their exact times, which are not rounded to
            // frames.
            const bool in_time = !isLate(made->passed[i].time_s - keys[i].time_s, interval_s);
            const bool rises = i == 0 || keys[i].time_s > reached[i - 1].time_s;
            if (in_time && rises) reached[i].time_s = keys[i].time_s;
        }
        keys = std::move(reached);
    }
    return keys;
}

Result<std::vector<MotionKey>> withKeysAlong(std::vector<MotionKey> keys,
                                             const Trajectory& trajectory,
                                             const TimingParams& timing, const JobContext& job) {
    constexpr double kStep_s = 1.0;
    const auto& frames = trajectory.frames;
    if (frames.empty()) return keys;
    const double interval_s = 1.0 / timing.frame_rate;
    double begin_s = 0.0;
    if (!keys.empty()) {
        const std::vector<MotionKey> gap = {keys.back(),
                                            {keys.back().time_s + interval_s, frames.front().pose}};
        const auto times = keyTimes(gap, motionLimits(timing), interval_s, job);
        if (!times) return tl::unexpected(times.error());
        begin_s = times->back();
    }
    double next_s = 0.0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const double time_s = frames[i].time_s - frames.front().time_s;
        // Omits a key that would be too near to the last one.
        const bool near_end = frames.back().time_s - frames[i].time_s < 0.5 * kStep_s;
        const bool last = i + 1 == frames.size();
        if (!last && (time_s < next_s - 1e-9 || near_end)) continue;
        keys.push_back({begin_s + time_s, frames[i].pose});
        next_s = time_s + kStep_s;
    }
    return keys;
}

std::vector<MotionKey> withReachedTimes(std::vector<MotionKey> keys,
                                        std::span<const PassedKey> passed, double interval_s) {
    for (std::size_t i = 0; i < std::min(keys.size(), passed.size()); ++i) {
        keys[i].time_s = passed[i].time_s;
        if (i > 0) keys[i].time_s = std::max(keys[i].time_s, keys[i - 1].time_s + interval_s);
    }
    return keys;
}

}  // namespace dollytrack::planning
