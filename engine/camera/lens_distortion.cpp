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
    const double rise = k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3);  // of radial, by r^2
    const double mixed = 2.0 * rise * x * y + 2.0 * p1 * x + 2.0 * p2 * y;
    Eigen::Matrix2d slope;
    slope << radial + 2.0 * rise * x * x + 2.0 * p1 * y + 6.0 * p2 * x, mixed, mixed,
        radial + 2.0 * rise * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
    return slope;
}

std::optional<Eigen::Vector2d> LensDistortion::straighten(const Eigen::Vector2d& bent) const {
    if (none()) return bent;
    // Outwards in steps, each solved by Newton's method, so that the branch is the one that
    // contains the middle. Where the model folds over its slope loses a direction.
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
    return at;
}

}  // namespace dollytrack
