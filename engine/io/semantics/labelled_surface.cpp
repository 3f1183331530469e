#include "engine/io/semantics/labelled_surface.h"

#include "engine/geometry/closest_on_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::semantics {

Corners cornersOf(const MeshPart& part, const Triangle& triangle, const Eigen::Affine3d& rotation) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = rotation * part.positions[triangle[k]].cast<double>();
    }
    return corners;
}

Eigen::Vector3d middleOf(const Corners& corners) {
    return (corners[0] + corners[1] + corners[2]) / 3.0;
}

LabelledSurface::LabelledSurface(const RawScene& labelled) {
    constexpr double kSame = 1e-6;  // of the diagonal
    for (const MeshPart& part : labelled.parts) {
        if (!part.triangles.empty()) box_.extend(part.bounds.cast<double>());
    }
    if (!box_.isEmpty() && box_.diagonal().norm() > 0.0) key_step_ = kSame * box_.diagonal().norm();
    for (std::size_t i = 0; i < labelled.objects.size(); ++i) {
        const int number = static_cast<int>(i) + 1;
        for (const std::size_t p : labelled.objects[i].parts) {
            const MeshPart& part = labelled.parts[p];
            for (const Triangle& t : part.triangles) {
                // Of equal triangles only that of the lowest object is kept.
                if (!same_.try_emplace(keyOf(cornersOf(part, t)), number).second) continue;
                triangles_.push_back(
                    {{part.positions[t[0]], part.positions[t[1]], part.positions[t[2]]}, number});
            }
        }
    }
    if (!triangles_.empty()) build(0, triangles_.size());
}

LabelledSurface::Key LabelledSurface::keyOf(const Corners& corners) const {
    constexpr double kMost = 1e15;
    Key key{};
    for (std::size_t k = 0; k < 3; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
            const double steps = (corners[k][axis] - box_.min()[axis]) / key_step_;
            key[k][axis] = std::llround(std::clamp(steps, -kMost, kMost));
        }
    }
    std::ranges::sort(key);
    return key;
}

/// Splits the triangles at their median along the longest side of their box; depth is logarithmic.
void LabelledSurface::build(std::size_t begin, std::size_t end) {
    constexpr std::size_t kLeaf = 8;
    const std::size_t index = nodes_.size();
    nodes_.push_back({{}, begin, end, 0, std::numeric_limits<int>::max()});
    Eigen::AlignedBox3f box;
    for (std::size_t i = begin; i < end; ++i) {
        for (const Eigen::Vector3f& corner : triangles_[i].corners) box.extend(corner);
        nodes_[index].lowest = std::min(nodes_[index].lowest, triangles_[i].object);
    }
    nodes_[index].box = box;
    if (end - begin <= kLeaf) return;
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) {
        return triangles_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(begin), at(middle), at(end), [axis](const Labelled& a, const Labelled& b) {
        const auto sum = [axis](const Labelled& t) {
            return t.corners[0][axis] + t.corners[1][axis] + t.corners[2][axis];
        };
        return sum(a) < sum(b);
    });
    build(begin, middle);
    nodes_[index].second = nodes_.size();
    build(middle, end);
}

/// Calls visit(distance, object) for the triangles, visiting nearer nodes first. A node is skipped
/// if skip() is true for its distance and lowest object number; a triangle likewise for its own.
template <class Skip, class Visit>
void LabelledSurface::visitNear(const Eigen::Vector3d& point, Skip&& skip, Visit&& visit) const {
    const auto distanceOf = [&](std::size_t node) {
        return nodes_[node].box.cast<double>().exteriorDistance(point);
    };
    std::vector<std::size_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
        const std::size_t index = open.back();
        open.pop_back();
        const Node& node = nodes_[index];
        if (skip(distanceOf(index), node.lowest)) continue;
        if (node.second > 0) {
            const bool first_nearer = distanceOf(index + 1) <= distanceOf(node.second);
            open.push_back(first_nearer ? node.second : index + 1);
            open.push_back(first_nearer ? index + 1 : node.second);
            continue;
        }
        for (std::size_t i = node.begin; i < node.end; ++i) {
            const auto& [a, b, c] = triangles_[i].corners;
            const Eigen::Vector3d closest =
                closestOnTriangle(point, a.cast<double>(), b.cast<double>(), c.cast<double>());
            const double distance = (closest - point).norm();
            if (!skip(distance, triangles_[i].object)) visit(distance, triangles_[i].object);
        }
    }
}

int LabelledSurface::objectAt(const Corners& corners, double radius) const {
    const auto same = same_.find(keyOf(corners));
    if (same != same_.end()) return same->second;
    constexpr double kEqual = 1e-4;  // of the radius
    const Eigen::Vector3d point = middleOf(corners);
    const double reach = std::min(distance(point, radius) + kEqual * radius, radius);
    int lowest = std::numeric_limits<int>::max();
    visitNear(
        point, [&](double distance, int object) { return distance > reach || object >= lowest; },
        [&](double /*distance*/, int object) { lowest = object; });
    return lowest == std::numeric_limits<int>::max() ? 0 : lowest;
}

double LabelledSurface::distance(const Eigen::Vector3d& point, double radius) const {
    double least = radius;
    visitNear(
        point, [&](double distance, int /*object*/) { return !(distance < least); },
        [&](double distance, int /*object*/) { least = distance; });
    return least;
}

}  // namespace dollytrack::semantics
