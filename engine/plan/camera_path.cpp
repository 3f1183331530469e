#include "engine/plan/camera_path.h"

#include <algorithm>
#include <array>

namespace dollytrack {
namespace {

Eigen::Vector3d curvePoint(const SmoothPath::Piece& piece, double t) {
    const double u = 1.0 - t;
    return u * u * piece.start + 2.0 * u * t * piece.control + t * t * piece.end;
}

/// The parameter at which a share of the curve's length lies behind: a Bezier curve is faster at
/// its ends than in its middle, and the camera must not be.
double parameterAtShare(const SmoothPath::Piece& piece, double share) {
    if (!piece.curved) return share;
    constexpr int kSteps = 32;
    std::array<double, kSteps + 1> travelled{};
    Eigen::Vector3d last = piece.start;
    for (int i = 1; i <= kSteps; ++i) {
        const Eigen::Vector3d point = curvePoint(piece, static_cast<double>(i) / kSteps);
        travelled[i] = travelled[i - 1] + (point - last).norm();
        last = point;
    }
    const double wanted = share * travelled[kSteps];
    const auto above = std::lower_bound(travelled.begin() + 1, travelled.end() - 1, wanted);
    const auto i = static_cast<std::size_t>(above - travelled.begin());
    const double step = travelled[i] - travelled[i - 1];
    return (static_cast<double>(i - 1) + (step > 0.0 ? (wanted - travelled[i - 1]) / step : 0.0)) /
           kSteps;
}

}  // namespace

Eigen::Vector3d SmoothPath::at(double arc_m) const {
    for (const Piece& piece : pieces) {
        if (arc_m > piece.length_m && &piece != &pieces.back()) {
            arc_m -= piece.length_m;
            continue;
        }
        const double share =
            piece.length_m > 0.0 ? std::clamp(arc_m / piece.length_m, 0.0, 1.0) : 0.0;
        return curvePoint(piece, parameterAtShare(piece, share));
    }
    return Eigen::Vector3d::Zero();
}

}  // namespace dollytrack
