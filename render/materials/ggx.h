#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::render {

// The isotropic GGX microfacet distribution (Walter et al. 2007; Heitz 2014). Directions are in a
// frame whose z axis is the surface normal. `alpha` is the distribution's width.

/// Density of facets with this normal, 1/sr.
[[nodiscard]] inline double ggxDensity(const Eigen::Vector3d& facet, double alpha) {
    const double a2 = alpha * alpha;
    const double z2 = facet.z() * facet.z();
    const double base = (facet.x() * facet.x() + facet.y() * facet.y()) / a2 + z2;
    return 1.0 / (std::numbers::pi * a2 * base * base);
}

/// Smith's lambda: the masking of a direction is 1 / (1 + lambda).
[[nodiscard]] inline double ggxLambda(const Eigen::Vector3d& way, double alpha) {
    const double z2 = way.z() * way.z();
    if (z2 <= 0.0) return 1e12;
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * std::max(0.0, 1.0 - z2) / z2) - 1.0);
}

/// Samples the normal of a facet visible from `out` (Heitz, Sampling the GGX Distribution of
/// Visible Normals, JCGT 7(4), 2018). Its density is the visible share of ggxDensity(). `where`
/// holds two uniform numbers.
[[nodiscard]] inline Eigen::Vector3d ggxVisibleFacet(const Eigen::Vector3d& out, double alpha,
                                                     const std::array<double, 2>& where) {
    const Eigen::Vector3d seen =
        Eigen::Vector3d(alpha * out.x(), alpha * out.y(), out.z()).normalized();
    const double aside = seen.x() * seen.x() + seen.y() * seen.y();
    const Eigen::Vector3d u =
        aside > 0.0 ? Eigen::Vector3d(Eigen::Vector3d(-seen.y(), seen.x(), 0.0) / std::sqrt(aside))
                    : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d v = seen.cross(u);
    const double radius = std::sqrt(where[0]);
    const double angle = 2.0 * std::numbers::pi * where[1];
    const double x = radius * std::cos(angle);
    const double half = 0.5 * (1.0 + seen.z());
    const double y =
        (1.0 - half) * std::sqrt(std::max(0.0, 1.0 - x * x)) + half * radius * std::sin(angle);
    const double z = std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
    const Eigen::Vector3d facet = x * u + y * v + z * seen;
    return Eigen::Vector3d(alpha * facet.x(), alpha * facet.y(), std::max(1e-9, facet.z()))
        .normalized();
}

/// Schlick's weight of F90, for the cosine between direction and facet normal.
[[nodiscard]] inline double schlick(double cosine) {
    const double away = std::clamp(1.0 - cosine, 0.0, 1.0);
    return away * away * away * away * away;
}

}  // namespace dollytrack::render
