#include "planning/timing/frame_moves.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

constexpr double kOnPath = 1e-6;      // m; smaller offsets are rounding
constexpr double kSamePlace = 1e-12;  // m

SmoothPath::Piece straight(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    SmoothPath::Piece piece;
    piece.start = from;
    piece.control = 0.5 * (from + to);
    piece.end = to;
    return piece;
}

/// The part of a curve between two parameters, as a Bezier curve.
SmoothPath::Piece partOf(const SmoothPath::Piece& piece, double begin, double end) {
    if (!piece.curved) return straight(piece.at(begin), piece.at(end));
    SmoothPath::Piece part;
    part.start = piece.at(begin);
    part.end = piece.at(end);
    part.control = (1.0 - begin) * (1.0 - end) * piece.start +
                   ((1.0 - begin) * end + begin * (1.0 - end)) * piece.control +
                   begin * end * piece.end;
    part.curved = true;
    return part;
}

}  // namespace

std::vector<SmoothPath::Piece> moveBetween(const SmoothPath& path, const TrajectoryFrame& from,
                                           const TrajectoryFrame& to) {
    const double way = to.arc_m - from.arc_m;
    if (path.pieces.empty() || way < kSamePlace) {
        return {straight(from.pose.position, to.pose.position)};
    }
    const Eigen::Vector3d first_aside = from.pose.position - path.at(from.arc_m);
    const Eigen::Vector3d last_aside = to.pose.position - path.at(to.arc_m);
    std::vector<SmoothPath::Piece> move;
    for (std::size_t i = path.pieceAt(from.arc_m); i < path.pieces.size(); ++i) {
        const SmoothPath::Piece& piece = path.pieces[i];
        if (i > path.pieceAt(from.arc_m) && piece.begin_m >= to.arc_m) break;
        const double begin_m = std::max(from.arc_m, piece.begin_m);
        const double end_m = std::min(to.arc_m, piece.begin_m + piece.length_m);
        if (end_m <= begin_m) continue;
        SmoothPath::Piece part = partOf(piece, piece.parameterAt(begin_m - piece.begin_m),
                                        piece.parameterAt(end_m - piece.begin_m));
        // An offset linear in the curve's parameter leaves it a quadratic Bezier curve.
        const auto aside = [&](double arc_m) -> Eigen::Vector3d {
            return first_aside + (arc_m - from.arc_m) / way * (last_aside - first_aside);
        };
        part.start += aside(begin_m);
        part.end += aside(end_m);
        part.control = part.curved ? (part.control + 0.5 * (aside(begin_m) + aside(end_m))).eval()
                                   : (0.5 * (part.start + part.end)).eval();
        move.push_back(part);
    }
    return move;
}

bool isOffPath(const SmoothPath& path, const TrajectoryFrame& frame) {
    return path.pieces.empty() || (path.at(frame.arc_m) - frame.pose.position).norm() > kOnPath;
}

}  // namespace dollytrack::planning
