#include "planning/collision/flat_obstacles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace dollytrack::planning {
namespace {

// Thinner polygons are stored as line segments: closest points on slivers are ill-conditioned.
constexpr double kSliver_m = 1e-4;

using Corners = std::vector<Eigen::Vector3d>;

/// Clips a convex polygon at a height (Sutherland and Hodgman, 1974).
Corners cutAt(const Corners& corners, double height, bool keep_above) {
    const auto above = [&](const Eigen::Vector3d& p) {
        return keep_above ? p.z() - height : height - p.z();
    };
    Corners kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector3d& from = corners[i];
        const Eigen::Vector3d& to = corners[(i + 1) % corners.size()];
        if (above(from) >= 0.0) kept.push_back(from);
        if ((above(from) > 0.0 && above(to) < 0.0) || (above(from) < 0.0 && above(to) > 0.0)) {
            kept.push_back(from + (to - from) * (above(from) / (above(from) - above(to))));
        }
    }
    return kept;
}

double crossOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

void FlatObstacles::beginObject() {
    Object object;
    object.id = static_cast<int>(flat_.objects.size()) + 1;
    object.first_vertex = static_cast<std::uint32_t>(flat_.positions.size());
    object.first_triangle = static_cast<std::uint32_t>(flat_.triangles.size());
    flat_.objects.push_back(std::move(object));
}

bool FlatObstacles::endObject() {
    Object& object = flat_.objects.back();
    object.vertex_count = static_cast<std::uint32_t>(flat_.positions.size()) - object.first_vertex;
    object.triangle_count =
        static_cast<std::uint32_t>(flat_.triangles.size()) - object.first_triangle;
    if (object.triangle_count > 0) return true;
    flat_.objects.pop_back();
    return false;
}

void FlatObstacles::addPolygon(std::span<const Eigen::Vector2d> corners) {
    const auto first = static_cast<std::uint32_t>(flat_.positions.size());
    for (const Eigen::Vector2d& corner : corners) {
        flat_.positions.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()),
                                     0.0F);
    }
    double area = 0.0;
    std::array<std::uint32_t, 2> ends = {0, 0};
    double longest = 0.0;
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
        area +=
            0.5 * crossOf(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
        for (std::uint32_t j = 0; j < i; ++j) {
            const double length = (corners[i] - corners[j]).norm();
            if (length <= longest) continue;
            longest = length;
            ends = {j, i};
        }
    }
    // A vertical polygon projects to a line segment.
    if (std::abs(area) < kSliver_m * longest || corners.size() < 3) {
        flat_.triangles.push_back({first + ends[0], first + ends[1], first + ends[1]});
        return;
    }
    for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) {
        flat_.triangles.push_back({first, first + i, first + i + 1});
    }
}

bool FlatObstacles::addObject(const Scene& scene, const Object& object) {
    beginObject();
    for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
        const Triangle& triangle = scene.triangles[object.first_triangle + t];
        Corners corners;
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (int k = 0; k < 3; ++k) {
            corners.push_back(scene.positions[triangle[k]].cast<double>());
            low = std::min(low, corners.back().z());
            high = std::max(high, corners.back().z());
        }
        if (high < bottom_ || low > top_) continue;
        if (low < bottom_) corners = cutAt(corners, bottom_, true);
        if (high > top_) corners = cutAt(corners, top_, false);
        if (corners.empty()) continue;
        std::vector<Eigen::Vector2d> flat;
        for (const Eigen::Vector3d& corner : corners) flat.emplace_back(corner.head<2>());
        addPolygon(flat);
    }
    return endObject();
}

bool FlatObstacles::addBox(const OrientedBox& box) {
    const double z = box.center.z();
    if (z + box.half_size.z() < bottom_ || z - box.half_size.z() > top_) return false;
    const Eigen::Vector3d& half = box.half_size;
    std::array<Eigen::Vector2d, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
        const double x = i == 0 || i == 3 ? -half.x() : half.x();
        const double y = i < 2 ? -half.y() : half.y();
        corners[i] = box.toWorld({x, y, 0.0}).head<2>();
    }
    beginObject();
    addPolygon(corners);
    return endObject();
}

void FlatObstacles::addSquare(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    const std::array<Eigen::Vector2d, 4> corners = {low, Eigen::Vector2d(high.x(), low.y()), high,
                                                    Eigen::Vector2d(low.x(), high.y())};
    addPolygon(corners);
}

}  // namespace dollytrack::planning
