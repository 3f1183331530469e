#include "engine/plan/camera_path.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dollytrack {
namespace {

/// Speed and length of a quadratic Bezier in closed form: with u = t + offset,
/// |B'(t)| = scale * sqrt(u^2 + gap), and its integral is elementary.
struct Bezier {
    Eigen::Vector3d velocity;  // B'(0)
    Eigen::Vector3d change;    // B''
    double scale = 0.0;        // |B''|
    double offset = 0.0;
    double gap = 0.0;

    explicit Bezier(const SmoothPath::Piece& piece)
        : velocity(2.0 * (piece.control - piece.start)),
          change(2.0 * (piece.start - 2.0 * piece.control + piece.end)),
          scale(change.norm()) {
        if (isEven()) return;
        offset = velocity.dot(change) / (scale * scale);
        gap = std::max(0.0, velocity.squaredNorm() / (scale * scale) - offset * offset);
    }

    /// Whether the speed is constant up to rounding errors.
    [[nodiscard]] bool isEven() const { return scale <= 1e-9 * velocity.norm(); }

    [[nodiscard]] double speed(double t) const { return (velocity + t * change).norm(); }

    [[nodiscard]] double lengthTo(double t) const {
        if (isEven()) return t * velocity.norm();
        return scale * (integral(t + offset) - integral(offset));
    }

  private:
    [[nodiscard]] double integral(double u) const {
        const double root = std::sqrt(gap);
        return 0.5 * (u * std::sqrt(u * u + gap) + (root > 0.0 ? gap * std::asinh(u / root) : 0.0));
    }
};

}  // namespace

Eigen::Vector3d SmoothPath::Piece::at(double t) const {
    const double u = 1.0 - t;
    return u * u * start + 2.0 * u * t * control + t * t * end;
}

double SmoothPath::Piece::parameterAt(double way_m) const {
    if (length_m <= 0.0) return 0.0;
    const double first = std::clamp(way_m / length_m, 0.0, 1.0);
    if (!curved || first <= 0.0 || first >= 1.0) return first;
    // A Bezier curve is faster at its ends than in its middle, but the camera's speed must be
    // constant. Newton's method with bounds, because without them it diverges where the curve
    // nearly stops.
    const Bezier curve(*this);
    double low = 0.0;
    double high = 1.0;
    double t = first;
    for (int i = 0; i < 40; ++i) {
        const double excess = curve.lengthTo(t) - way_m;
        if (std::abs(excess) <= 1e-13 * length_m) break;
        (excess > 0.0 ? high : low) = t;
        const double speed = curve.speed(t);
        const double next = speed > 0.0 ? t - excess / speed : low;
        t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return t;
}

double SmoothPath::Piece::curvature(double t) const {
    const Bezier curve(*this);
    const Eigen::Vector3d velocity = curve.velocity + t * curve.change;
    const double speed = velocity.norm();
    return speed > 0.0 ? velocity.cross(curve.change).norm() / (speed * speed * speed) : 0.0;
}

void SmoothPath::append(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                        const Eigen::Vector3d& end, bool curved) {
    Piece piece{start, control, end, 0.0, curved, length_m};
    piece.length_m = curved ? Bezier(piece).lengthTo(1.0) : (end - start).norm();
    if (piece.length_m < 1e-9) return;
    length_m += piece.length_m;
    pieces.push_back(piece);
}

std::size_t SmoothPath::pieceAt(double arc_m) const {
    const auto after =
        std::upper_bound(pieces.begin(), pieces.end(), arc_m,
                         [](double arc, const Piece& piece) { return arc < piece.begin_m; });
    return after == pieces.begin() ? 0 : static_cast<std::size_t>(after - pieces.begin()) - 1;
}

Eigen::Vector3d SmoothPath::at(double arc_m) const {
    if (pieces.empty()) return Eigen::Vector3d::Zero();
    const Piece& piece = pieces[pieceAt(arc_m)];
    return piece.at(piece.parameterAt(arc_m - piece.begin_m));
}

}  // namespace dollytrack
