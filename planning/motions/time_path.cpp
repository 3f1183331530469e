#include "planning/motions/time_path.h"

#include "engine/document/given_motion.h"
#include "planning/collision/swept_sphere.h"
#include "planning/motions/rate_profile.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {
namespace {

// A rest shorter than this share of an interval has no frame of its own.
constexpr double kRest = 0.01;
// Repaired stretches are at most this many times as fast as the fastest given move.
constexpr double kFaster = 2.0;
// Parts of moves that get another time, and their number in a path, about.
constexpr double kLongestPart_m = 0.05;
constexpr double kLargestPart_rad = 0.05;
constexpr double kMostParts = 1e6;
// Factor of the speed where moves between frames would collide, and how often it is applied.
constexpr double kSlower = 0.6;
constexpr int kSlowdowns = 8;
constexpr double kShortest_s = 0.001;  // between frames
constexpr double kSmallest = 1e-9;     // m, rad or s

double secondsOf(const TrajectoryFrame& from, const TrajectoryFrame& to) {
    return to.time_s - from.time_s;
}

bool isOver(double way_m, double turn_rad, double seconds, const MotionLimits& limits) {
    const double time = kLimitTolerance * seconds;
    return way_m > limits.speed_mps * time + kSmallest ||
           turn_rad > limits.turn_rps * time + kSmallest;
}

double timeAt(double frame, std::span<const TrajectoryFrame> given) {
    const auto i = static_cast<std::size_t>(frame);
    if (i + 1 >= given.size()) return given.back().time_s;
    return given[i].time_s + (frame - static_cast<double>(i)) * secondsOf(given[i], given[i + 1]);
}

/// Largest acceleration by differences between frames, m/s2.
double largestAcceleration(const std::vector<Eigen::Vector3d>& positions,
                           const std::vector<double>& times) {
    double largest = 0.0;
    for (std::size_t i = 0; i + 2 < positions.size(); ++i) {
        const double first = times[i + 1] - times[i];
        const double second = times[i + 2] - times[i + 1];
        if (!(first > 0.0 && second > 0.0)) continue;
        const Eigen::Vector3d change = (positions[i + 2] - positions[i + 1]) / second -
                                       (positions[i + 1] - positions[i]) / first;
        largest = std::max(largest, 2.0 * change.norm() / (first + second));
    }
    return largest;
}

class PathTimer {
  public:
    PathTimer(const SweptSphere& sphere, const PathTiming& timing,
              std::span<const TrajectoryFrame> given, std::vector<PathPoint> points,
              const JobContext& job)
        : sphere_(sphere), timing_(timing), given_(given), points_(std::move(points)), job_(job) {}

    TimedPath run() {
        job_.report(0.0);
        if (!timing_.retime_all) keepFrames();
        if (job_.cancelled()) return {};
        divideMoves();
        makePieces();
        setTimes(pieces_, usedLimits(), timing_.smooth_over_s);
        if (needsTooManyFrames()) return {};
        for (int k = 0; k < kSlowdowns && timing_.fixed_rate && slowWhereBlocked(); ++k) {
            job_.report(0.5 * (k + 1) / kSlowdowns);
            setTimes(pieces_, usedLimits(), timing_.smooth_over_s);
            if (needsTooManyFrames()) return {};
        }
        job_.report(0.5);
        const auto first = static_cast<std::size_t>(points_.front().frame);
        addFrame(points_.front(), given_[first].time_s);
        for (std::size_t i = 0; i < pieces_.size();) {
            const std::size_t end = changedUntil(i);
            if (end > i) {
                placeFrames(i, end);
                i = end;
            } else {
                addFrame(points_[i + 1], made_.frames.back().time_s + pieces_[i].given_s);
                ++i;
            }
            if (job_.cancelled()) return {};
        }
        return std::move(made_);
    }

  private:
    [[nodiscard]] bool needsTooManyFrames() const {
        double seconds = 0.0;
        for (const TimedPiece& piece : pieces_) seconds += piece.changed ? piece.time_s : 0.0;
        const auto most = static_cast<double>(kMostMotionFrames);
        return !(seconds < most * timing_.frame_interval_s);
    }

    /// Leaves the points between frames out of those repaired stretches that can keep their frames
    /// and times.
    void keepFrames() {
        std::vector<Eigen::Vector3d> positions;
        std::vector<double> times;
        for (const TrajectoryFrame& frame : given_) {
            positions.push_back(frame.pose.position);
            times.push_back(frame.time_s);
        }
        const double acceleration =
            std::max(timing_.limits.acceleration_mps2, largestAcceleration(positions, times));
        std::vector<PathPoint> kept;
        for (std::size_t i = 0; i < points_.size();) {
            std::size_t end = i;
            while (points_[end].repaired_next) ++end;
            std::vector<PathPoint> frames;
            for (std::size_t k = i; k < end; ++k) {
                if (points_[k].frame == std::floor(points_[k].frame)) frames.push_back(points_[k]);
            }
            if (end > i && canKeep(frames, i, end, acceleration)) {
                for (PathPoint& frame : frames) frame.repaired_next = false;
                kept.insert(kept.end(), frames.begin(), frames.end());
            } else {
                kept.insert(kept.end(), points_.begin() + static_cast<std::ptrdiff_t>(i),
                            points_.begin() + static_cast<std::ptrdiff_t>(end));
            }
            kept.push_back(points_[end]);
            i = end + 1;
        }
        points_ = std::move(kept);
    }

    /// Whether straight moves over these frames of a stretch, from point `first` to point `last`,
    /// are free and within the limits at the given times.
    [[nodiscard]] bool canKeep(std::vector<PathPoint> frames, std::size_t first, std::size_t last,
                               double acceleration) const {
        frames.push_back(points_[last]);
        std::vector<Eigen::Vector3d> positions;
        std::vector<double> times;
        const auto add = [&](const PathPoint& point) {
            positions.push_back(point.position);
            times.push_back(timeAt(point.frame, given_));
        };
        if (first > 0) add(points_[first - 1]);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            add(frames[i]);
            if (i + 1 == frames.size()) break;
            if (job_.cancelled()) return false;
            const PathPoint& next = frames[i + 1];
            const double seconds = timeAt(next.frame, given_) - times.back();
            const double turn = poseAt(frames[i]).rotation.angularDistance(poseAt(next).rotation);
            if (isOver((next.position - frames[i].position).norm(), turn, seconds,
                       timing_.limits) ||
                !sphere_.segment(frames[i].position, next.position).free) {
                return false;
            }
        }
        if (last + 1 < points_.size()) add(points_[last + 1]);
        return largestAcceleration(positions, times) <= kLimitTolerance * acceleration;
    }

    /// Divides moves that get another time, so that the speed can change along them.
    void divideMoves() {
        std::vector<PathPoint> divided;
        const double most = kMostParts / static_cast<double>(points_.size());
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            const PathPoint from = points_[i];
            const PathPoint& to = points_[i + 1];
            divided.push_back(from);
            const TimedPiece piece = pieceBetween(from, to);
            if (!piece.retime) continue;
            const double parts =
                std::min(most, std::ceil(std::max(piece.move.norm() / kLongestPart_m,
                                                  piece.turn.norm() / kLargestPart_rad)));
            for (double k = 1.0; k < parts; k += 1.0) {
                divided.push_back({from.position + k / parts * (to.position - from.position),
                                   from.frame + k / parts * (to.frame - from.frame),
                                   from.repaired_next});
            }
        }
        divided.push_back(points_.back());
        points_ = std::move(divided);
    }

    [[nodiscard]] TimedPiece pieceBetween(const PathPoint& from, const PathPoint& to) const {
        TimedPiece piece;
        piece.move = to.position - from.position;
        piece.turn = rotationVector(poseAt(from).rotation, poseAt(to).rotation);
        piece.given_s = std::max(0.0, timeAt(to.frame, given_) - timeAt(from.frame, given_));
        piece.retime = timing_.retime_all || from.repaired_next ||
                       isOver(piece.move.norm(), piece.turn.norm(), piece.given_s, timing_.limits);
        return piece;
    }

    void makePieces() {
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            pieces_.push_back(pieceBetween(points_[i], points_[i + 1]));
        }
    }

    [[nodiscard]] MotionLimits usedLimits() const {
        double fastest = 0.0;
        for (std::size_t i = 0; i + 1 < given_.size(); ++i) {
            const double seconds = secondsOf(given_[i], given_[i + 1]);
            if (seconds <= 0.0) continue;
            const double way = (given_[i + 1].pose.position - given_[i].pose.position).norm();
            fastest = std::max(fastest, way / seconds);
        }
        MotionLimits limits = timing_.limits;
        if (fastest > 0.0) limits.speed_mps = std::min(limits.speed_mps, kFaster * fastest);
        return limits;
    }

    [[nodiscard]] Pose poseAt(const PathPoint& point) const {
        return {point.position, orientationAt(point, given_, timing_)};
    }

    void addFrame(const PathPoint& point, double time_s) {
        const auto nearest = static_cast<std::size_t>(point.frame);
        TrajectoryFrame frame = given_[nearest];
        if (point.frame != std::floor(point.frame)) frame.position_point = -1;
        if (timing_.look_at) frame.target_in_world = *timing_.look_at;
        frame.time_s = time_s;
        frame.pose = poseAt(point);
        made_.frames.push_back(frame);
        made_.given_frames.push_back(point.frame);
    }

    struct Sample {
        PathPoint point;
        std::size_t piece = 0;
    };

    /// The point of the pieces begin to end - 1 after a time.
    [[nodiscard]] Sample sampleAt(std::size_t begin, std::size_t end, double time_s) const {
        std::size_t i = begin;
        while (i + 1 < end && time_s >= pieces_[i].time_s) time_s -= pieces_[i++].time_s;
        const double time = pieces_[i].time_s;
        const double share =
            time > 0.0 ? pieces_[i].shareAt(std::clamp(time_s / time, 0.0, 1.0)) : 1.0;
        const PathPoint& from = points_[i];
        const PathPoint& to = points_[i + 1];
        if (share >= 1.0) return {to, i};
        return {{from.position + share * (to.position - from.position),
                 from.frame + share * (to.frame - from.frame), true},
                i};
    }

    [[nodiscard]] bool isMoveFree(const Sample& from, const Sample& to) const {
        return from.piece == to.piece ||
               sphere_.segment(from.point.position, to.point.position).free;
    }

    /// The end of the pieces from `begin` on whose time is changed.
    [[nodiscard]] std::size_t changedUntil(std::size_t begin) const {
        std::size_t end = begin;
        while (end < pieces_.size() && pieces_[end].changed) ++end;
        return end;
    }

    /// Time between frames on the pieces begin to end - 1: the frame interval or a little less.
    [[nodiscard]] double stepOn(std::size_t begin, std::size_t end) const {
        double total = 0.0;
        for (std::size_t i = begin; i < end; ++i) total += pieces_[i].time_s;
        return total / std::max(1.0, std::ceil(total / timing_.frame_interval_s - 1e-6));
    }

    /// Slows down the pieces where the straight move from one frame to the next would collide.
    /// Returns false if there are none.
    bool slowWhereBlocked() {
        bool any = false;
        for (std::size_t begin = 0; begin < pieces_.size(); ++begin) {
            const std::size_t end = changedUntil(begin);
            if (end == begin) continue;
            const double step = stepOn(begin, end);
            Sample last{points_[begin], begin};
            double rest = 0.0;  // of a step, after the pieces before `piece`
            std::size_t piece = begin;
            while (piece < end && !job_.cancelled()) {
                rest += step;
                while (piece < end && rest >= pieces_[piece].time_s) {
                    rest -= pieces_[piece++].time_s;
                }
                Sample next{points_[end], end - 1};
                if (piece < end) next = sampleAt(piece, piece + 1, rest);
                if (!isMoveFree(last, next)) {
                    any = true;
                    for (std::size_t k = last.piece; k <= next.piece; ++k) {
                        pieces_[k].slowdown *= kSlower;
                    }
                }
                last = next;
                if (step <= 0.0) break;
            }
            begin = end;
        }
        return any;
    }

    /// Frames at the frame interval along the pieces begin to end - 1. Where the straight move from
    /// one to the next would collide, the next is placed nearer; at the latest, on the next point.
    void placeFrames(std::size_t begin, std::size_t end) {
        double total = 0.0;
        std::vector<double> ends;  // by piece: its end in time
        for (std::size_t i = begin; i < end; ++i) ends.push_back(total += pieces_[i].time_s);
        const double interval = timing_.frame_interval_s;
        const double step = stepOn(begin, end);
        Sample last{points_[begin], begin};
        double time = 0.0;
        for (bool done = false; !done && !job_.cancelled();) {
            double next = time + step;
            done = next >= total - kRest * step;
            if (done) next = total;
            Sample sample = done ? Sample{points_[end], end - 1} : sampleAt(begin, end, next);
            for (const double share : {0.75, 0.5, 0.25}) {
                if (isMoveFree(last, sample)) break;
                done = false;
                next = time + share * step;
                sample = sampleAt(begin, end, next);
            }
            if (!isMoveFree(last, sample)) {
                next = ends[last.piece - begin];
                sample = {points_[last.piece + 1], last.piece + 1};
            }
            const double took = timing_.fixed_rate ? interval : std::max(next - time, kShortest_s);
            addFrame(sample.point, made_.frames.back().time_s + took);
            last = sample;
            time = next;
        }
    }

    const SweptSphere& sphere_;
    const PathTiming& timing_;
    std::span<const TrajectoryFrame> given_;
    std::vector<PathPoint> points_;
    std::vector<TimedPiece> pieces_;  // one less than points
    TimedPath made_;
    const JobContext& job_;
};

}  // namespace

Eigen::Vector3d rotationVector(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
    const Eigen::AngleAxisd turn(to * from.conjugate());
    const double full = 2.0 * EIGEN_PI;
    const double angle = turn.angle() > EIGEN_PI ? turn.angle() - full : turn.angle();
    return angle * turn.axis();
}

bool isOverLimits(const TrajectoryFrame& from, const TrajectoryFrame& to,
                  const MotionLimits& limits) {
    return isOver((to.pose.position - from.pose.position).norm(),
                  angleBetween(from.pose.rotation, to.pose.rotation), secondsOf(from, to), limits);
}

Eigen::Quaterniond orientationAt(const PathPoint& point, std::span<const TrajectoryFrame> given,
                                 const PathTiming& timing) {
    if (timing.look_at) return lookAlong(*timing.look_at - point.position);
    const auto i = static_cast<std::size_t>(point.frame);
    const double share = point.frame - static_cast<double>(i);
    if (share <= 0.0 || i + 1 >= given.size()) return given[i].pose.rotation;
    return given[i].pose.rotation.slerp(share, given[i + 1].pose.rotation).normalized();
}

TimedPath timePath(const SweptSphere& sphere, const PathTiming& timing,
                   std::span<const TrajectoryFrame> given, std::vector<PathPoint> points,
                   const JobContext& job) {
    return PathTimer(sphere, timing, given, std::move(points), job).run();
}

}  // namespace dollytrack::planning
