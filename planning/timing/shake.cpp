#include "planning/timing/shake.h"

#include "engine/core/random.h"
#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/plan_params.h"
#include "planning/timing/frame_moves.h"
#include "planning/viewpoints/candidate_evaluator.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {

constexpr double kFade_s = 0.5;         // from none to full shake
constexpr double kSwayShrink = 0.6;     // factor of each reduction
constexpr double kLeastShare = 0.1;     // smaller shares become 0
constexpr int kSwayGrid = 16;           // rays per side, to test whether a key frame keeps its
                                        // captures
constexpr std::uint64_t kStream = 977;  // of the random generator

using Vector6 = Eigen::Matrix<double, 6, 1>;

class Shaker {
  public:
    Shaker(const std::vector<SmoothPath>& paths, const std::vector<TrajectoryFrame>& steady,
           const std::vector<PositionPoint>& points, const ViewEstimator& views,
           const SweptSphere& sphere, const ShakeParams& params, const PitchBand& pitch, int seed)
        : paths_(paths),
          steady_(steady),
          points_(points),
          views_(views),
          sphere_(sphere),
          params_(params),
          pitch_(pitch),
          offsets_(steady_.size()),
          moved_(steady_.size(), 1.0),
          turned_(steady_.size(), 1.0) {
        const CameraShake camera_shake(params, seed);
        parallelFor(steady_.size(),
                    [&](std::size_t i) { offsets_[i] = camera_shake.at(steady_[i].time_s); });
    }

    /// Sets the share of shake at ends of paths and at key frames, and fades around them.
    void fadeAtKeys() {
        parallelFor(steady_.size(), [&](std::size_t i) {
            if (!joined(i) || !joined(i + 1)) {
                moved_[i] = turned_[i] = 0.0;
                return;
            }
            double share = 1.0;
            while (share > 0.0 && !keepsCaptures(i, shaken(i, share, share))) {
                share = share * kSwayShrink < kLeastShare ? 0.0 : share * kSwayShrink;
            }
            moved_[i] = turned_[i] = share;
        });
        spread(moved_);
        spread(turned_);
    }

    /// Reduces the shake around colliding moves. Returns false if none collides.
    bool shrinkAtCollisions() {
        std::vector<char> touches(steady_.size(), 0);  // whether the move to this frame collides
        parallelFor(steady_.size(), [&](std::size_t i) {
            // Without shake the camera follows its path, which smoothing has proven.
            if (!joined(i) || (moved_[i - 1] <= 0.0 && moved_[i] <= 0.0)) return;
            touches[i] = !isFree(i);
        });
        bool any = false;
        std::vector<double> shares = moved_;
        for (std::size_t i = 0; i < touches.size(); ++i) {
            if (!touches[i]) continue;
            any = true;
            for (const std::size_t end : {i - 1, i}) {
                const double less = moved_[end] * kSwayShrink;
                shares[end] = std::min(shares[end], less < kLeastShare ? 0.0 : less);
                // The captures were tested with another position.
                if (steady_[end].position_point >= 0) shares[end] = turned_[end] = 0.0;
            }
        }
        if (!any) return false;
        moved_ = std::move(shares);
        spread(moved_);
        spread(turned_);
        return true;
    }

    [[nodiscard]] Pose pose(std::size_t i) const { return shaken(i, moved_[i], turned_[i]); }

  private:
    /// Whether the camera moves to this frame from the previous one.
    [[nodiscard]] bool joined(std::size_t i) const {
        return i > 0 && i < steady_.size() && steady_[i].path == steady_[i - 1].path;
    }

    [[nodiscard]] Pose shaken(std::size_t i, double moved, double turned) const {
        Pose pose = steady_[i].pose;
        if (moved > 0.0) {
            pose.position +=
                pose.rotation * (moved * params_.shake_amplitude_m * offsets_[i].head<3>());
        }
        if (turned > 0.0) {
            const Eigen::Vector3d turn = turned * params_.shake_amplitude_deg * std::numbers::pi /
                                         180.0 * offsets_[i].tail<3>();
            if (turn.norm() > 0.0) {
                pose.rotation = (pose.rotation * Eigen::Quaterniond(Eigen::AngleAxisd(
                                                     turn.norm(), turn.normalized())))
                                    .normalized();
            }
            pose.rotation = tiltedBack(pose.rotation);
        }
        return pose;
    }

    /// Rotates about the horizontal axis across the view, so that the shake's roll stays.
    [[nodiscard]] Eigen::Quaterniond tiltedBack(const Eigen::Quaterniond& rotation) const {
        const Eigen::Vector3d forward = rotation * Eigen::Vector3d::UnitZ();
        const double elevation = elevationOf(forward);
        const double back = pitch_.nearest(elevation) - elevation;
        const Eigen::Vector3d across = forward.cross(Eigen::Vector3d::UnitZ());
        if (!pitch_.restricts() || back == 0.0 || across.norm() < 1e-9) return rotation;
        return (Eigen::AngleAxisd(back, across.normalized()) * rotation).normalized();
    }

    [[nodiscard]] TrajectoryFrame movedFrame(std::size_t i) const {
        TrajectoryFrame frame = steady_[i];
        frame.pose = shaken(i, moved_[i], 0.0);
        return frame;
    }

    /// Whether the move to this frame is collision-free.
    [[nodiscard]] bool isFree(std::size_t i) const {
        const std::size_t path = steady_[i].path;
        const auto move = moveBetween(paths_[path], movedFrame(i - 1), movedFrame(i));
        return std::ranges::all_of(move, [&](const SmoothPath::Piece& piece) {
            return sphere_.bezier(piece.start, piece.control, piece.end).free;
        });
    }

    [[nodiscard]] bool keepsCaptures(std::size_t i, const Pose& pose) const {
        const int key = steady_[i].position_point;
        if (key < 0) return true;
        const PositionPoint& point = points_[key];
        if (point.fixed) return false;
        return std::all_of(point.captured.begin(), point.captured.end(), [&](int id) {
            const auto estimate = views_.estimate(pose, id, kSwayGrid);
            const bool was_well =
                std::binary_search(point.well_captured.begin(), point.well_captured.end(), id);
            return was_well ? isSafelyWellCaptured(estimate) : isSafelyCaptured(estimate);
        });
    }

    /// Limits the difference between shares of neighbouring frames to what the fade allows.
    void spread(std::vector<double>& shares) const {
        const auto step = [&](std::size_t i) {
            return (steady_[i].time_s - steady_[i - 1].time_s) / kFade_s;
        };
        for (std::size_t i = 1; i < shares.size(); ++i) {
            if (joined(i)) shares[i] = std::min(shares[i], shares[i - 1] + step(i));
        }
        for (std::size_t i = shares.size(); i-- > 1;) {
            if (joined(i)) shares[i - 1] = std::min(shares[i - 1], shares[i] + step(i));
        }
    }

    const std::vector<SmoothPath>& paths_;
    const std::vector<TrajectoryFrame>& steady_;
    const std::vector<PositionPoint>& points_;
    const ViewEstimator& views_;
    const SweptSphere& sphere_;
    const ShakeParams& params_;
    PitchBand pitch_;
    std::vector<Vector6> offsets_;
    std::vector<double> moved_, turned_;  // share of the shake, 0..1
};

}  // namespace

CameraShake::CameraShake(const ShakeParams& params, int seed) {
    Random random(static_cast<std::uint64_t>(seed), kStream);
    constexpr double kTurn = 2.0 * std::numbers::pi;
    for (auto& channel : waves_) {
        if (params.shake == ShakeKind::Sinusoidal) {
            // Different frequencies; with one the camera would move along a line.
            const double hertz = params.shake_hz * random.uniform(0.8, 1.25);
            channel.push_back({1.0, kTurn * hertz, random.uniform(0.0, kTurn)});
            continue;
        }
        // Handheld: slow drift is largest, tremor smallest.
        constexpr int kWaves = 8;
        double sum = 0.0;
        for (int i = 0; i < kWaves; ++i) {
            const double octaves = -2.0 + 4.0 * (i + random.uniform()) / kWaves;
            const double share = std::exp2(-0.8 * octaves);
            channel.push_back(
                {share, kTurn * params.shake_hz * std::exp2(octaves), random.uniform(0.0, kTurn)});
            sum += share;
        }
        for (Wave& wave : channel) wave.share /= sum;
    }
}

Vector6 CameraShake::at(double time_s) const {
    Vector6 offset = Vector6::Zero();
    for (std::size_t channel = 0; channel < waves_.size(); ++channel) {
        for (const Wave& wave : waves_[channel]) {
            offset[static_cast<Eigen::Index>(channel)] +=
                wave.share * std::sin(wave.radians_per_s * time_s + wave.phase);
        }
    }
    return offset;
}

Result<Trajectory> shakeTrajectory(const std::vector<SmoothPath>& paths, Trajectory trajectory,
                                   const std::vector<PositionPoint>& position_points,
                                   const ViewEstimator& views, const SweptSphere& sphere,
                                   const ShakeParams& params, const PitchBand& pitch, int seed,
                                   const JobContext& job) {
    if (params.shake == ShakeKind::None || trajectory.frames.empty()) return trajectory;
    const std::vector<std::size_t> order = motionOrder(trajectory);
    const std::vector<TrajectoryFrame> steady = motionFrames(trajectory);
    Shaker shaker(paths, steady, position_points, views, sphere, params, pitch, seed);
    shaker.fadeAtKeys();
    // This ends: each round lowers some share, and small shares become 0.
    while (!job.cancelled() && shaker.shrinkAtCollisions()) {
    }
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    const std::size_t kept = trajectory.frames.size();
    for (std::size_t i = 0; i < order.size(); ++i) {
        TrajectoryFrame& frame =
            order[i] < kept ? trajectory.frames[order[i]] : trajectory.left_out[order[i] - kept];
        const double distance = (frame.target_in_world - frame.pose.position).norm();
        frame.pose = shaker.pose(i);
        frame.target_in_world = frame.pose.position + distance * frame.pose.forward();
    }
    return trajectory;
}

}  // namespace dollytrack::planning
