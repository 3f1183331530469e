#include "planning/baselines/delaunay.h"

#include <Eigen/LU>

#include <algorithm>
#include <map>
#include <utility>

namespace dollytrack::planning {
namespace {

using Triangle = std::array<int, 3>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Positive if `p` is inside the circle through a, b, c (counter-clockwise).
double inCircle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                const Eigen::Vector2d& p) {
    Eigen::Matrix3d m;
    const std::array<Eigen::Vector2d, 3> from = {a - p, b - p, c - p};
    for (int i = 0; i < 3; ++i) {
        const Eigen::Vector2d& v = from[i];
        m.row(i) << v.x(), v.y(), v.squaredNorm();
    }
    return m.determinant();
}

}  // namespace

std::vector<Triangle> delaunay(const std::vector<Eigen::Vector2d>& points) {
    if (points.size() < 3) return {};
    Eigen::Vector2d low = points.front();
    Eigen::Vector2d high = points.front();
    for (const Eigen::Vector2d& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double size = std::max((high - low).maxCoeff(), 1e-6);
    const Eigen::Vector2d middle = 0.5 * (low + high);
    // A triangle around all points, removed at the end; large enough not to cut corners off the
    // hull.
    std::vector<Eigen::Vector2d> all = points;
    all.push_back(middle + 1e4 * size * Eigen::Vector2d(-1.0, -1.0));
    all.push_back(middle + 1e4 * size * Eigen::Vector2d(1.0, -1.0));
    all.push_back(middle + 1e4 * size * Eigen::Vector2d(0.0, 1.0));
    const int count = static_cast<int>(points.size());
    const auto at = [&](int i) -> const Eigen::Vector2d& { return all[i]; };
    std::vector<Triangle> triangles = {{count, count + 1, count + 2}};
    for (int p = 0; p < count; ++p) {
        const bool known = std::any_of(points.begin(), points.begin() + p, [&](const auto& q) {
            return (q - at(p)).norm() < 1e-9 * size;
        });
        if (known) continue;
        // Remove the triangles whose circumcircle contains the point, and connect their outline to
        // it.
        std::map<std::pair<int, int>, int> edges;
        std::vector<Triangle> kept;
        for (const Triangle& t : triangles) {
            if (inCircle(at(t[0]), at(t[1]), at(t[2]), at(p)) <= 0.0) {
                kept.push_back(t);
                continue;
            }
            for (std::size_t i = 0; i < 3; ++i) {
                const std::pair edge(t[i], t[(i + 1) % 3]);
                if (edges.erase({edge.second, edge.first}) == 0) edges[edge] = 1;
            }
        }
        for (const auto& [edge, one] : edges) {
            if (cross(at(edge.second) - at(edge.first), at(p) - at(edge.first)) > 0.0) {
                kept.push_back({edge.first, edge.second, p});
            }
        }
        triangles = std::move(kept);
    }
    std::erase_if(triangles, [&](const Triangle& t) {
        return std::any_of(t.begin(), t.end(), [&](int i) { return i >= count; });
    });
    return triangles;
}

}  // namespace dollytrack::planning
