#include "engine/generate/upright_box.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dollytrack::generate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The triangle in the box's frame: relative to its centre, along its axes.
TriangleInRoom inBox(const TriangleInRoom& triangle, const UprightBox& box) {
    const Vector2d across = acrossAt(box.angle);
    const Vector2d forward = forwardAt(box.angle);
    TriangleInRoom local;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector2d apart = triangle[i].head<2>() - box.centre;
        local[i] = {across.dot(apart), forward.dot(apart),
                    triangle[i].z() - 0.5 * (box.high + box.low)};
    }
    return local;
}

bool separates(const Vector3d& axis, const TriangleInRoom& t, const Vector3d& half) {
    if (axis.squaredNorm() < 1e-18) return false;
    const std::array<double, 3> p = {axis.dot(t[0]), axis.dot(t[1]), axis.dot(t[2])};
    const double reach = half.dot(axis.cwiseAbs());
    return *std::min_element(p.begin(), p.end()) > reach ||
           *std::max_element(p.begin(), p.end()) < -reach;
}

}  // namespace

Vector2d forwardAt(double angle) {
    return {-std::sin(angle), std::cos(angle)};
}

Vector2d acrossAt(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

double reachAlong(const UprightBox& box, const Vector2d& direction) {
    return box.half.x() * std::abs(acrossAt(box.angle).dot(direction)) +
           box.half.y() * std::abs(forwardAt(box.angle).dot(direction));
}

bool near(const UprightBox& a, const UprightBox& b, double gap) {
    if (a.low > b.high + gap || b.low > a.high + gap) return false;
    const Vector2d apart = b.centre - a.centre;
    for (const double angle : {a.angle, b.angle}) {
        for (const Vector2d& axis : {acrossAt(angle), forwardAt(angle)}) {
            if (std::abs(apart.dot(axis)) > reachAlong(a, axis) + reachAlong(b, axis) + gap) {
                return false;
            }
        }
    }
    return true;
}

bool reachesInto(const TriangleInRoom& triangle, const UprightBox& box) {
    const Vector3d half(box.half.x(), box.half.y(), 0.5 * (box.high - box.low));
    const TriangleInRoom t = inBox(triangle, box);
    const std::array<Vector3d, 3> edges = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    for (int axis = 0; axis < 3; ++axis) {
        if (separates(Vector3d::Unit(axis), t, half)) return false;
        for (const Vector3d& edge : edges) {
            if (separates(Vector3d::Unit(axis).cross(edge), t, half)) return false;
        }
    }
    return !separates(edges[0].cross(edges[1]), t, half);
}

}  // namespace dollytrack::generate
