#include "planning/metrics/minimum_clearance.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "planning/timing/frame_moves.h"

#include <algorithm>
#include <limits>

namespace dollytrack::planning {
namespace {

constexpr double kExact = 1e-4;  // m

struct Near {
    double distance = std::numeric_limits<double>::infinity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// The smallest distance on one piece, if it is below `least` by more than kExact; else `least`.
class PieceSearch {
  public:
    PieceSearch(const SmoothPath::Piece& piece, const RayCaster& rays, const Near& least)
        : piece_(piece),
          rays_(rays),
          least_(least),
          // The speed of a quadratic Bezier curve is largest at one of its ends.
          speed_(2.0 * std::max((piece.control - piece.start).norm(),
                                (piece.end - piece.control).norm())) {}

    Near run() {
        search(0.0, 1.0);
        return least_;
    }

  private:
    void search(double begin, double end) {
        const double middle = 0.5 * (begin + end);
        const double reach = 0.5 * (end - begin) * speed_;  // farthest the camera gets from the
                                                            // middle
        const Eigen::Vector3d position = piece_.at(middle);
        const double distance = rays_.closest(position, least_.distance + reach).distance;
        if (distance < least_.distance) least_ = {distance, position};
        if (reach < kExact || distance - reach > least_.distance - kExact) return;
        search(begin, middle);
        search(middle, end);
    }

    const SmoothPath::Piece& piece_;
    const RayCaster& rays_;
    Near least_;
    double speed_;
};

int nearestFrame(const Trajectory& trajectory, const Eigen::Vector3d& position) {
    const auto nearest =
        std::ranges::min_element(trajectory.frames, {}, [&](const TrajectoryFrame& frame) {
            return (frame.pose.position - position).squaredNorm();
        });
    return static_cast<int>(nearest - trajectory.frames.begin());
}

}  // namespace

MinimumClearance findMinimumClearance(const std::vector<SmoothPath>& paths,
                                      const Trajectory& trajectory, const RayCaster& rays) {
    MinimumClearance clearance;
    if (trajectory.frames.empty()) return clearance;
    const std::vector<TrajectoryFrame> frames = motionFrames(trajectory);
    std::vector<Near> at_frames(frames.size());
    parallelFor(at_frames.size(), [&](std::size_t i) {
        const Eigen::Vector3d& position = frames[i].pose.position;
        at_frames[i] = {rays.closest(position).distance, position};
    });
    Near least = *std::ranges::min_element(at_frames, {}, &Near::distance);

    std::vector<SmoothPath::Piece> pieces;
    for (const SmoothPath& path : paths) {
        pieces.insert(pieces.end(), path.pieces.begin(), path.pieces.end());
    }
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        const TrajectoryFrame& from = frames[i];
        const TrajectoryFrame& to = frames[i + 1];
        const SmoothPath& path = paths[from.path];
        if (from.path != to.path || (!isOffPath(path, from) && !isOffPath(path, to))) {
            continue;
        }
        const std::vector<SmoothPath::Piece> move = moveBetween(path, from, to);
        pieces.insert(pieces.end(), move.begin(), move.end());
    }
    // All pieces start from the same bound, so the result does not depend on the number of threads.
    std::vector<Near> on_pieces(pieces.size());
    parallelFor(pieces.size(),
                [&](std::size_t i) { on_pieces[i] = PieceSearch(pieces[i], rays, least).run(); });
    for (const Near& one : on_pieces) {
        if (one.distance < least.distance) least = one;
    }
    const ClosestPoint surface = rays.closest(least.position);
    clearance.clearance_m = least.distance;
    clearance.position = least.position;
    clearance.object_id = surface.object_id;
    clearance.frame = nearestFrame(trajectory, least.position);
    return clearance;
}

}  // namespace dollytrack::planning
