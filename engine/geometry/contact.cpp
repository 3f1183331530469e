#include "engine/geometry/contact.h"

#include <algorithm>
#include <cmath>

namespace dollytrack {
namespace {

constexpr std::size_t kMostTriangles = 1500;  // of each object that are compared with the other's

using Corners = std::array<Eigen::Vector3f, 3>;

Eigen::AlignedBox3f boundsOf(const std::vector<SurfaceView>& surfaces) {
    Eigen::AlignedBox3f box;
    for (const SurfaceView& surface : surfaces) {
        for (const auto& p : surface.positions) box.extend(p);
    }
    return box;
}

std::vector<Corners> trianglesNear(const std::vector<SurfaceView>& surfaces,
                                   const Eigen::AlignedBox3f& region) {
    std::vector<Corners> near;
    for (const SurfaceView& surface : surfaces) {
        for (const auto& t : surface.triangles) {
            Corners corners;
            Eigen::AlignedBox3f box;
            for (std::size_t i = 0; i < 3; ++i) {
                corners[i] = surface.positions[t[i]];
                box.extend(corners[i]);
            }
            if (box.intersects(region)) near.push_back(corners);
        }
    }
    if (near.size() > kMostTriangles) {
        std::vector<Corners> fewer;
        for (std::size_t i = 0; i < kMostTriangles; ++i) {
            fewer.push_back(near[i * near.size() / kMostTriangles]);
        }
        near = std::move(fewer);
    }
    return near;
}

/// Closest point of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
Eigen::Vector3f closestOn(const Corners& t, const Eigen::Vector3f& p) {
    const Eigen::Vector3f ab = t[1] - t[0];
    const Eigen::Vector3f ac = t[2] - t[0];
    const Eigen::Vector3f ap = p - t[0];
    const float d1 = ab.dot(ap);
    const float d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return t[0];
    const Eigen::Vector3f bp = p - t[1];
    const float d3 = ab.dot(bp);
    const float d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return t[1];
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return t[0] + ab * (d1 / (d1 - d3));
    const Eigen::Vector3f cp = p - t[2];
    const float d5 = ab.dot(cp);
    const float d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return t[2];
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return t[0] + ac * (d2 / (d2 - d6));
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        return t[1] + (t[2] - t[1]) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    const float sum = va + vb + vc;
    return t[0] + ab * (vb / sum) + ac * (vc / sum);
}

/// Whether the segment intersects the triangle, and where.
bool crosses(const Corners& t, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
             Eigen::Vector3f& at) {
    const Eigen::Vector3f direction = to - from;
    const Eigen::Vector3f ab = t[1] - t[0];
    const Eigen::Vector3f ac = t[2] - t[0];
    const Eigen::Vector3f h = direction.cross(ac);
    const float det = ab.dot(h);
    if (std::abs(det) < 1e-20F) return false;
    const Eigen::Vector3f s = from - t[0];
    const float u = s.dot(h) / det;
    const Eigen::Vector3f q = s.cross(ab);
    const float v = direction.dot(q) / det;
    const float along = ac.dot(q) / det;
    if (u < 0 || v < 0 || u + v > 1 || along < 0 || along > 1) return false;
    at = from + along * direction;
    return true;
}

void collect(const std::vector<Corners>& a, const std::vector<Corners>& b, float gap,
             std::vector<Eigen::Vector3f>& places) {
    std::vector<Eigen::AlignedBox3f> boxes;
    for (const Corners& t : b) {
        Eigen::AlignedBox3f box;
        for (const auto& p : t) box.extend(p);
        box.min().array() -= gap;
        box.max().array() += gap;
        boxes.push_back(box);
    }
    for (const Corners& t : a) {
        Eigen::AlignedBox3f box;
        for (const auto& p : t) box.extend(p);
        for (std::size_t k = 0; k < b.size(); ++k) {
            if (!boxes[k].intersects(box)) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                Eigen::Vector3f at;
                if ((closestOn(b[k], t[i]) - t[i]).squaredNorm() <= gap * gap) {
                    places.push_back(t[i]);
                } else if (crosses(b[k], t[i], t[(i + 1) % 3], at)) {
                    places.push_back(at);
                }
            }
        }
        if (places.size() > 4096) return;
    }
}

}  // namespace

std::vector<Eigen::Vector3f> findContact(const std::vector<SurfaceView>& a,
                                         const std::vector<SurfaceView>& b, float gap) {
    Eigen::AlignedBox3f region = boundsOf(a).intersection(boundsOf(b));
    // For boxes closer than the gap the intersection is inverted by less than the gap; growing it
    // makes it valid.
    region.min().array() -= gap;
    region.max().array() += gap;
    std::vector<Eigen::Vector3f> places;
    if (region.isEmpty()) return places;
    const std::vector<Corners> near_a = trianglesNear(a, region);
    const std::vector<Corners> near_b = trianglesNear(b, region);
    collect(near_a, near_b, gap, places);
    collect(near_b, near_a, gap, places);
    return places;
}

}  // namespace dollytrack
