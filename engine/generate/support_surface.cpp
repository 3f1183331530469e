#include "engine/generate/support_surface.h"

#include "engine/generate/placed_model.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::generate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// cm
constexpr double kLift = 0.05;          // gap between an object and its supporting surface
constexpr double kUneven = 0.6;         // largest height difference of the supporting points
constexpr double kShelfHeadroom = 1.0;  // free height above an object in a shelf
constexpr double kSupported = 0.7;      // position of the supporting points: share of half the size

/// Height at which the vertical line through p intersects a triangle; null if it does not.
std::optional<double> heightAt(const TriangleInRoom& t, const Vector2d& p) {
    const auto side = [&](const Vector3d& a, const Vector3d& b) {
        return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
    };
    const double u = side(t[1], t[2]);
    const double v = side(t[2], t[0]);
    const double w = side(t[0], t[1]);
    const double sum = u + v + w;
    if (std::abs(sum) < 1e-9) return std::nullopt;
    const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
    if (!inside) return std::nullopt;
    return (u * t[0].z() + v * t[1].z() + w * t[2].z()) / sum;
}

std::vector<double> heightsAt(const std::vector<const TriangleInRoom*>& triangles,
                              const Vector2d& p) {
    std::vector<double> heights;
    for (const TriangleInRoom* t : triangles) {
        if (const auto height = heightAt(*t, p)) heights.push_back(*height);
    }
    std::sort(heights.begin(), heights.end());
    return heights;
}

}  // namespace

SupportSurface::SupportSurface(const homes::FurnitureModel& model, const PlacedPiece& placed)
    : supporter_(placed.box()), triangles_(trianglesOf(model, placed)) {}

SupportSurface::Nearby SupportSurface::trianglesIn(const UprightBox& box) const {
    const double reach_x = reachAlong(box, Vector2d::UnitX());
    const double reach_y = reachAlong(box, Vector2d::UnitY());
    const auto apart = [](const TriangleInRoom& t, int axis, double low, double high) {
        const auto [least, most] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        return most < low || least > high;
    };
    Nearby nearby;
    for (const TriangleInRoom& t : triangles_) {
        if (apart(t, 0, box.centre.x() - reach_x, box.centre.x() + reach_x)) continue;
        if (apart(t, 1, box.centre.y() - reach_y, box.centre.y() + reach_y)) continue;
        if (apart(t, 2, box.low, box.high)) continue;
        nearby.push_back(&t);
    }
    return nearby;
}

bool SupportSurface::isFree(const UprightBox& box) const {
    const Nearby nearby = trianglesIn(box);
    return std::none_of(nearby.begin(), nearby.end(),
                        [&](const auto* t) { return reachesInto(*t, box); });
}

UprightBox SupportSurface::accessBox(const UprightBox& box) const {
    const Vector2d across = acrossAt(supporter_.angle);
    const Vector2d forward = forwardAt(supporter_.angle);
    const double back = forward.dot(box.centre - supporter_.centre) - reachAlong(box, forward);
    const double front = supporter_.half.y() + 1.0;
    UprightBox access = box;
    access.angle = supporter_.angle;
    access.half = {reachAlong(box, across), 0.5 * (front - back)};
    access.centre = supporter_.centre + across.dot(box.centre - supporter_.centre) * across +
                    0.5 * (front + back) * forward;
    return access;
}

std::optional<SupportSurface::Placement> SupportSurface::placementFor(const PlacedPiece& item,
                                                                      Random& random) const {
    UprightBox column = item.box();
    column.low = supporter_.low;
    column.high = supporter_.high;
    const Nearby below = trianglesIn(column);
    const std::vector<double> middle = heightsAt(below, item.at);
    if (middle.empty()) return std::nullopt;
    std::vector<std::vector<double>> corners;
    for (const double x : {-kSupported, kSupported}) {
        for (const double y : {-kSupported, kSupported}) {
            const Vector2d corner = item.at + x * column.half.x() * acrossAt(item.angle) +
                                    y * column.half.y() * forwardAt(item.angle);
            corners.push_back(heightsAt(below, corner));
        }
    }
    const std::size_t first = random.below(static_cast<std::uint32_t>(middle.size()));
    for (std::size_t k = 0; k < middle.size(); ++k) {
        const double height = middle[(first + k) % middle.size()];
        double base = height;
        const bool held = std::all_of(corners.begin(), corners.end(), [&](const auto& heights) {
            bool any = false;
            for (const double at_corner : heights) {
                if (std::abs(at_corner - height) > kUneven) continue;
                base = std::max(base, at_corner);
                any = true;
            }
            return any;
        });
        if (!held) continue;
        UprightBox box = item.box();
        box.low = base + 0.5 * kLift;
        box.high = base + kLift + item.piece->height;
        UprightBox from_above = box;
        from_above.high = std::max(supporter_.high, box.high) + 1.0;
        UprightBox in_shelf = box;
        in_shelf.high += kShelfHeadroom;
        if (isFree(from_above)) return Placement{base + kLift, std::nullopt};
        const UprightBox access = accessBox(in_shelf);
        if (isFree(access)) return Placement{base + kLift, access};
    }
    return std::nullopt;
}

}  // namespace dollytrack::generate
