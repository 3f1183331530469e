#include "engine/io/pointcloud/hole_filler.h"

#include "engine/core/disjoint_sets.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace dollytrack {
namespace {

using Rim = std::vector<std::uint32_t>;  // boundary loop: vertex indices in order

constexpr std::size_t kLongestRim = 200;  // vertices; the time of filling is cubic in it

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(a) << 32U | b;
}

/// The closed boundary loops, opposite to the triangles' orientation. Loops that touch themselves
/// or each other are left out.
std::vector<Rim> findRims(std::span<const Triangle> triangles) {
    std::unordered_map<std::uint64_t, int> edges;
    for (const Triangle& t : triangles) {
        for (std::size_t i = 0; i < 3; ++i) ++edges[edgeKey(t[i], t[(i + 1) % 3])];
    }
    std::map<std::uint32_t, std::uint32_t> next;  // next vertex along the boundary
    std::set<std::uint32_t> touched;              // vertices with several boundary edges
    for (const Triangle& t : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i];
            const std::uint32_t b = t[(i + 1) % 3];
            if (edges.contains(edgeKey(b, a))) continue;
            if (!next.try_emplace(b, a).second) touched.insert(b);
        }
    }
    std::vector<Rim> rims;
    std::set<std::uint32_t> seen;
    for (const auto& [first, after] : next) {
        if (seen.contains(first)) continue;
        Rim rim;
        bool simple = true;
        std::uint32_t at = first;
        while (seen.insert(at).second) {
            rim.push_back(at);
            simple = simple && !touched.contains(at);
            const auto found = next.find(at);
            if (found == next.end()) break;
            at = found->second;
        }
        if (simple && at == first && rim.size() >= 3) rims.push_back(std::move(rim));
    }
    return rims;
}

double lengthOf(std::span<const Eigen::Vector3d> points, const Rim& rim) {
    double length = 0.0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        length += (points[rim[(i + 1) % rim.size()]] - points[rim[i]]).norm();
    }
    return length;
}

/// The connected components of a mesh, as sets of vertices.
DisjointSets<std::uint32_t> joinCorners(std::size_t corners, std::span<const Triangle> triangles) {
    DisjointSets<std::uint32_t> pieces(corners);
    for (const Triangle& t : triangles) {
        for (std::size_t i = 1; i < 3; ++i) pieces.join(t[i], t[0]);
    }
    return pieces;
}

/// The triangulation of a boundary loop with the least area, by dynamic programming (Barequet and
/// Sharir 1995).
std::vector<Triangle> leastArea(std::span<const Eigen::Vector3d> points, const Rim& rim) {
    const std::size_t n = rim.size();
    std::vector<double> area(n * n, 0.0);  // least area between two vertices
    std::vector<std::uint32_t> apex(n * n, 0);
    const auto areaOf = [&](std::size_t i, std::size_t j, std::size_t k) {
        const Eigen::Vector3d& a = points[rim[i]];
        return 0.5 * (points[rim[j]] - a).cross(points[rim[k]] - a).norm();
    };
    for (std::size_t gap = 2; gap < n; ++gap) {
        for (std::size_t i = 0; i + gap < n; ++i) {
            const std::size_t k = i + gap;
            double best = std::numeric_limits<double>::infinity();
            for (std::size_t j = i + 1; j < k; ++j) {
                const double sum = area[i * n + j] + area[j * n + k] + areaOf(i, j, k);
                if (sum >= best) continue;
                best = sum;
                apex[i * n + k] = static_cast<std::uint32_t>(j);
            }
            area[i * n + k] = best;
        }
    }
    std::vector<Triangle> triangles;
    std::vector<std::pair<std::size_t, std::size_t>> open = {{0, n - 1}};
    while (!open.empty()) {
        const auto [i, k] = open.back();
        open.pop_back();
        if (k < i + 2) continue;
        const std::size_t j = apex[i * n + k];
        triangles.push_back({rim[i], rim[j], rim[k]});
        open.emplace_back(i, j);
        open.emplace_back(j, k);
    }
    return triangles;
}

}  // namespace

std::vector<Triangle> fillHoles(std::span<const Eigen::Vector3d> points,
                                std::span<const Triangle> triangles, double widest_m,
                                std::size_t& holes) {
    std::vector<Triangle> filling;
    if (!(widest_m > 0.0)) return filling;
    const std::vector<Rim> rims = findRims(triangles);
    DisjointSets<std::uint32_t> pieces = joinCorners(points.size(), triangles);
    std::map<std::uint32_t, std::pair<double, std::size_t>> outline;  // longest loop by component
    for (std::size_t i = 0; i < rims.size(); ++i) {
        auto& longest = outline[pieces.find(rims[i].front())];
        longest = std::max(longest, {lengthOf(points, rims[i]), i});
    }
    for (std::size_t i = 0; i < rims.size(); ++i) {
        const Rim& rim = rims[i];
        if (outline[pieces.find(rim.front())].second == i || rim.size() > kLongestRim) continue;
        Eigen::AlignedBox3d box;
        for (const std::uint32_t corner : rim) box.extend(points[corner]);
        if (box.diagonal().norm() > widest_m) continue;
        ++holes;
        const std::vector<Triangle> patch = leastArea(points, rim);
        filling.insert(filling.end(), patch.begin(), patch.end());
    }
    return filling;
}

}  // namespace dollytrack
