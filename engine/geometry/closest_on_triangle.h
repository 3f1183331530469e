#pragma once

#include <Eigen/Core>

namespace dollytrack {

/// Closest point of the triangle abc to p (Ericson, Real-Time Collision Detection, 5.1.5).
inline Eigen::Vector3d closestOnTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                         const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d ab = b - a;
    const Eigen::Vector3d ac = c - a;
    const Eigen::Vector3d ap = p - a;
    const double d1 = ab.dot(ap);
    const double d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const Eigen::Vector3d bp = p - b;
    const double d3 = ab.dot(bp);
    const double d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        return d1 - d3 > 0.0 ? Eigen::Vector3d(a + ab * (d1 / (d1 - d3))) : a;
    }
    const Eigen::Vector3d cp = p - c;
    const double d5 = ab.dot(cp);
    const double d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        return d2 - d6 > 0.0 ? Eigen::Vector3d(a + ac * (d2 / (d2 - d6))) : a;
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double length = (d4 - d3) + (d5 - d6);
        return length > 0.0 ? Eigen::Vector3d(b + (c - b) * ((d4 - d3) / length)) : b;
    }
    const double denominator = va + vb + vc;
    return a + ab * (vb / denominator) + ac * (vc / denominator);
}

}  // namespace dollytrack
