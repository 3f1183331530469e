#include "engine/camera/lens_distortion.h"

#include <Eigen/LU>

#include <cmath>

namespace dollytrack {

Eigen::Vector2d LensDistortion::bend(const Eigen::Vector2d& straight) const {
    const double x = straight.x(), y = straight.y();
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
            y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

Eigen::Matrix2d LensDistortion::slope(const Eigen::Vector2d& straight) const {
    const double x = straight.x(), y = straight.y();
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double rise = k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3);  // derivative of radial by r^2
    const double mixed = 2.0 * rise * x * y + 2.0 * p1 * x + 2.0 * p2 * y;
    Eigen::Matrix2d slope;
    slope << radial + 2.0 * rise * x * x + 2.0 * p1 * y + 6.0 * p2 * x, mixed, mixed,
        radial + 2.0 * rise * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
    return slope;
}

std::optional<Eigen::Vector2d> LensDistortion::straighten(const Eigen::Vector2d& bent) const {
    if (none()) return bent;
    // Moves outwards in steps, each solved by Newton's method, so that the solution stays on the
    // branch that contains the image centre. At a fold of the model the Jacobian becomes singular.
    constexpr int kSteps = 8;
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    for (int step = 1; step <= kSteps; ++step) {
        const Eigen::Vector2d goal = bent * (static_cast<double>(step) / kSteps);
        double error = 0.0;
        for (int round = 0; round < 12; ++round) {
            const Eigen::Matrix2d here = slope(at);
            if (!(here.determinant() > 1e-3 && here.trace() > 0.0)) return std::nullopt;
            const Eigen::Vector2d miss = bend(at) - goal;
            error = miss.norm();
            if (error < 1e-12) break;
            at -= here.inverse() * miss;
        }
        if (!(error < 1e-9)) return std::nullopt;
    }
    // A Newton step may have jumped over a fold.
    if (!risesTo(at.norm())) return std::nullopt;
    return at;
}

bool LensDistortion::risesTo(double straight_radius) const {
    // The derivative of r (1 + k1 r^2 + k2 r^4 + k3 r^6) is a polynomial in s = r^2; its minimum is
    // at the end of the interval or where the polynomial's derivative is 0.
    const double a = 3.0 * k1, b = 5.0 * k2, c = 7.0 * k3;
    const double end = straight_radius * straight_radius;
    const auto rises = [&](double s) {
        return !(s > 0.0 && s <= end) || 1.0 + s * (a + s * (b + s * c)) > 0.0;
    };
    if (!rises(end)) return false;
    if (c == 0.0) return b == 0.0 || rises(-a / (2.0 * b));
    const double square = b * b - 3.0 * a * c;
    if (square < 0.0) return true;
    const double root = std::sqrt(square);
    return rises((-b - root) / (3.0 * c)) && rises((-b + root) / (3.0 * c));
}

}  // namespace dollytrack
