#include "planning/motions/repair_motion.h"

#include "engine/document/given_motion.h"
#include "engine/math/quantile.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/free_runs.h"
#include "planning/motions/motion_check.h"
#include "planning/motions/repair_path.h"
#include "planning/motions/time_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace dollytrack::planning {
namespace {

// Frames farther apart than this, as the median, are key frames.
constexpr double kKeyFrameSpacing = 0.25;  // m
// Progress of the repair of one path.
constexpr double kFreePartsFound = 0.2;
constexpr double kFreeWaysFound = 0.7;

using Frames = std::span<const TrajectoryFrame>;

bool isFinite(const TrajectoryFrame& frame) {
    return std::isfinite(frame.time_s) && frame.pose.position.allFinite() &&
           frame.pose.rotation.coeffs().allFinite();
}

/// The frames of each path.
std::vector<Frames> pathsOf(const Trajectory& given) {
    std::vector<Frames> paths;
    std::size_t first = 0;
    for (std::size_t i = 1; i <= given.frames.size(); ++i) {
        if (i < given.frames.size() && given.frames[i].path == given.frames[first].path) continue;
        paths.push_back(Frames(given.frames).subspan(first, i - first));
        first = i;
    }
    return paths;
}

double medianSpacing(const std::vector<Frames>& paths) {
    std::vector<double> moves;
    for (const Frames& frames : paths) {
        for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
            moves.push_back((frames[i + 1].pose.position - frames[i].pose.position).norm());
        }
    }
    if (moves.empty()) return 0.0;
    return upperMedian(std::move(moves));
}

/// Whether most moves are over the limits: then all frames are timed anew.
bool areTimesWrong(const std::vector<Frames>& paths, const MotionLimits& limits) {
    int over = 0;
    int moves = 0;
    for (const Frames& frames : paths) {
        for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
            ++moves;
            over += isOverLimits(frames[i], frames[i + 1], limits) ? 1 : 0;
        }
    }
    return 2 * over > moves;
}

double lengthOf(const Trajectory& trajectory) {
    double length_m = 0.0;
    for (const Frames& frames : pathsOf(trajectory)) {
        for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
            length_m += (frames[i + 1].pose.position - frames[i].pose.position).norm();
        }
    }
    return length_m;
}

PathTiming timingOf(const PlanParams& params, const Trajectory& given,
                    const std::vector<Frames>& paths) {
    PathTiming timing;
    timing.limits = motionLimits(params.timing);
    timing.frame_interval_s = medianStep_s(given.frames).value_or(given.frame_interval_s);
    const double wanted = 1.0 / params.timing.frame_rate;
    const bool far_apart = medianSpacing(paths) > kKeyFrameSpacing;
    timing.retime_all = far_apart && areTimesWrong(paths, timing.limits);
    if (timing.retime_all || !(timing.frame_interval_s > 0.0) ||
        !std::isfinite(timing.frame_interval_s)) {
        timing.frame_interval_s = wanted;
    }
    timing.fixed_rate = timing.retime_all || !far_apart;
    timing.smooth_over_s = std::min(timing.frame_interval_s, wanted);
    return timing;
}

class MotionRepair {
  public:
    MotionRepair(const MappedScene& scene, const PathTiming& timing, FarPath far_path)
        : scene_(scene), check_(scene), timing_(timing), far_path_(far_path) {}

    /// Adds the repaired path to the result, unless the job is cancelled. Error: BadInput.
    Status add(const Frames& frames, const JobContext& job) {
        const FreeParts parts = findFreeParts(check_, frames, job);
        if (job.cancelled()) return {};
        const bool is_free = count(frames, parts);
        const auto first = static_cast<double>(given_before_);
        given_before_ += frames.size();
        if (is_free && !timing_.retime_all) {
            addUnchanged(frames, first);
            return {};
        }
        job.report(kFreePartsFound);
        const auto paths = repairPath(scene_, check_, frames, parts, job);
        if (job.cancelled()) return {};
        if (paths.empty()) {
            if (far_path_ == FarPath::Keep) {
                addUnchanged(frames, first);
                return {};
            }
            return fail(ErrorCode::BadInput,
                        fmt::format("No frame of the path of {} frames from {:.2f} s on is within "
                                    "1 m of free space; check its units, axes and origin.",
                                    frames.size(), frames.front().time_s));
        }
        const JobContext timing = job.stage(kFreeWaysFound, 1.0, "timing");
        const auto share = 1.0 / static_cast<double>(paths.size());
        for (std::size_t i = 0; i < paths.size(); ++i) {
            const std::vector<PathPoint>& points = paths[i];
            measure(points, frames);
            const double done = share * static_cast<double>(i);
            auto timed = timePath(*scene_.sphere, timing_, frames, points,
                                  timing.stage(done, done + share, "timing"));
            if (job.cancelled()) return {};
            if (timed.frames.empty() ||
                result_.frames.size() + timed.frames.size() > kMostMotionFrames) {
                return fail(ErrorCode::BadInput,
                            fmt::format("The repaired trajectory would have more than {} frames; "
                                        "correct its times, or raise the motion limits.",
                                        kMostMotionFrames));
            }
            addPath(std::move(timed), first, frames[static_cast<std::size_t>(points.back().frame)]);
        }
        change_.paths_cut += std::max(0, static_cast<int>(paths.size()) - 1);
        changed_ = true;
        return {};
    }

    [[nodiscard]] RepairedMotion finish(const Trajectory& given) {
        const auto frames = static_cast<double>(given.frames.size());
        change_.mean_shift_m /= frames;
        change_.mean_turn_rad /= frames;
        change_.given_length_m = change_.length_m = lengthOf(given);
        if (!changed_) return {given, change_, std::move(given_frames_)};
        change_.length_m = lengthOf(result_);
        result_.frame_interval_s = timing_.frame_interval_s;
        change_.time_added_s = late_s_;
        return {std::move(result_), change_, std::move(given_frames_)};
    }

  private:
    /// Counts what must be repaired; true if nothing.
    bool count(const Frames& frames, const FreeParts& parts) {
        const auto bad = [](const std::vector<char>& free) {
            return static_cast<int>(std::count(free.begin(), free.end(), 0));
        };
        change_.frames_in_collision += bad(parts.frames);
        change_.moves_in_collision += bad(parts.moves);
        int over = 0;
        for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
            over += isOverLimits(frames[i], frames[i + 1], timing_.limits) ? 1 : 0;
        }
        change_.moves_over_limits += over;
        return bad(parts.frames) + bad(parts.moves) + over == 0;
    }

    void measure(const std::vector<PathPoint>& points, const Frames& frames) {
        for (const PathPoint& point : points) {
            if (point.frame != std::floor(point.frame)) continue;
            const Pose& given = frames[static_cast<std::size_t>(point.frame)].pose;
            const double shift = (point.position - given.position).norm();
            const double turn = angleBetween(orientationAt(point, frames, timing_), given.rotation);
            change_.frames_moved += shift > 0.0 ? 1 : 0;
            change_.mean_shift_m += shift;
            change_.mean_turn_rad += turn;
            change_.largest_shift_m = std::max(change_.largest_shift_m, shift);
            change_.largest_turn_rad = std::max(change_.largest_turn_rad, turn);
        }
    }

    /// Appends a path as it is.
    void addUnchanged(const Frames& frames, double given_first) {
        TimedPath kept{{frames.begin(), frames.end()}, std::vector<double>(frames.size())};
        std::iota(kept.given_frames.begin(), kept.given_frames.end(), 0.0);
        addPath(std::move(kept), given_first, frames.back());
    }

    /// Appends frames as one path, later by the time added to those before. `given_first` is the
    /// number of the given frame where its given frames begin, `given_last` the last one as given.
    void addPath(TimedPath path_frames, double given_first, const TrajectoryFrame& given_last) {
        std::vector<TrajectoryFrame>& frames = path_frames.frames;
        for (const double given : path_frames.given_frames) {
            given_frames_.push_back(given_first + given);
        }
        const int path = result_.frames.empty() ? 0 : result_.frames.back().path + 1;
        double late_s = late_s_;
        if (!result_.frames.empty()) {
            // Given paths may follow each other without a pause, or have no times at all.
            const double end_s = result_.frames.back().time_s;
            const double begin_s = frames.front().time_s + late_s;
            if (begin_s <= end_s) late_s += end_s + timing_.frame_interval_s - begin_s;
        }
        late_s_ = late_s + frames.back().time_s - given_last.time_s;
        double arc_m = 0.0;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            TrajectoryFrame& frame = frames[i];
            const Eigen::Vector3d& position = frame.pose.position;
            if (i > 0) arc_m += (position - frames[i - 1].pose.position).norm();
            frame.arc_m = arc_m;
            frame.path = path;
            frame.time_s += late_s;
            const int component = scene_.free_space->componentAt(position);
            if (component >= 0) frame.component = component;
        }
        result_.frames.insert(result_.frames.end(), frames.begin(), frames.end());
    }

    const MappedScene& scene_;
    MotionCheck check_;
    PathTiming timing_;
    FarPath far_path_;
    Trajectory result_;
    MotionChange change_;
    std::vector<double> given_frames_;
    std::size_t given_before_ = 0;  // given frames of the paths before
    bool changed_ = false;
    double late_s_ = 0.0;  // time added so far
};

}  // namespace

Result<RepairedMotion> repairAndTime(const MappedScene& scene, const PathTiming& timing,
                                     const Trajectory& given, const JobContext& job,
                                     FarPath far_path) {
    if (given.frames.empty()) {
        return fail(ErrorCode::BadInput, "The trajectory has no frames; nothing can be repaired.");
    }
    const auto broken = std::find_if_not(given.frames.begin(), given.frames.end(), isFinite);
    if (broken != given.frames.end()) {
        return fail(ErrorCode::BadInput,
                    fmt::format("Frame {} of the trajectory has a value that is not a number; "
                                "correct its pose or time.",
                                broken - given.frames.begin()));
    }
    const std::vector<Frames> paths = pathsOf(given);
    MotionRepair repair(scene, timing, far_path);
    const double share = 1.0 / static_cast<double>(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const double done = share * static_cast<double>(i);
        job.report(done);
        const Status status = repair.add(paths[i], job.stage(done, done + share, "repair"));
        if (job.cancelled()) {
            return fail(ErrorCode::Cancelled, "Repairing the trajectory was cancelled.");
        }
        if (!status) return tl::unexpected(status.error());
    }
    job.report(1.0);
    return repair.finish(given);
}

Result<RepairedMotion> repairMotion(const MappedScene& scene, const PlanParams& params,
                                    const Trajectory& given, const JobContext& job) {
    return repairAndTime(scene, timingOf(params, given, pathsOf(given)), given, job);
}

}  // namespace dollytrack::planning
