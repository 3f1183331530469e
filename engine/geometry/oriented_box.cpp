#include "engine/geometry/oriented_box.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace dollytrack {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Convex hull of the points' x and y, counter-clockwise (Andrew's monotone chain).
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points) {
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
        return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<Eigen::Vector2d> hull;
    const auto extend = [&](const Eigen::Vector2d& p, std::size_t keep) {
        while (hull.size() > keep + 1 &&
               cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
            hull.pop_back();
        }
        hull.push_back(p);
    };
    for (const auto& p : points) extend(p, 0);
    const std::size_t lower = hull.size() - 1;
    for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(*p, lower);
    hull.pop_back();
    return hull;
}

constexpr std::size_t kStrips = 256;

/// Strips of equal width along x.
class Strips {
  public:
    explicit Strips(const Eigen::AlignedBox3f& bounds)
        : from_(bounds.min().x()),
          width_(std::max(bounds.sizes().x(), std::numeric_limits<float>::min())) {}
    [[nodiscard]] std::size_t at(float x) const {
        const float share = (x - from_) / width_;
        return std::min<std::size_t>(kStrips - 1, static_cast<std::size_t>(share * kStrips));
    }
    [[nodiscard]] double edge(std::size_t i) const {
        return static_cast<double>(from_) +
               static_cast<double>(width_) / kStrips * static_cast<double>(i);
    }

  private:
    float from_;
    float width_;
};

/// The hull of the points that are extreme in their strip; contained in the hull of all points.
std::vector<Eigen::Vector2d> innerHull(std::span<const Eigen::Vector3f> points,
                                       const Strips& strips) {
    constexpr std::size_t kEnough = 4096;
    struct Extremes {
        Eigen::Vector2f low{0.0F, std::numeric_limits<float>::infinity()};
        Eigen::Vector2f high{0.0F, -std::numeric_limits<float>::infinity()};
        Eigen::Vector2f left{std::numeric_limits<float>::infinity(), 0.0F};
        Eigen::Vector2f right{-std::numeric_limits<float>::infinity(), 0.0F};
    };
    std::vector<Extremes> found(kStrips);
    const std::size_t step = std::max<std::size_t>(1, points.size() / kEnough);
    for (std::size_t k = 0; k < points.size(); k += step) {
        const Eigen::Vector2f q = points[k].head<2>();
        Extremes& s = found[strips.at(q.x())];
        if (q.y() < s.low.y()) s.low = q;
        if (q.y() > s.high.y()) s.high = q;
        if (q.x() < s.left.x()) s.left = q;
        if (q.x() > s.right.x()) s.right = q;
    }
    std::vector<Eigen::Vector2d> extremes;
    for (const Extremes& s : found) {
        if (!std::isfinite(s.low.y())) continue;
        for (const auto& q : {s.low, s.high, s.left, s.right}) extremes.push_back(q.cast<double>());
    }
    return convexHull(extremes);
}

/// The points on or outside the inner hull, the only candidates for corners of the full hull. For a
/// dense mesh this leaves few points, with the same result.
std::vector<Eigen::Vector2d> planCandidates(std::span<const Eigen::Vector3f> points,
                                            const Eigen::AlignedBox3f& bounds) {
    std::vector<Eigen::Vector2d> kept;
    const auto keep = [&](const Eigen::Vector3f& p) { kept.emplace_back(p.x(), p.y()); };
    const Strips strips(bounds);
    const std::vector<Eigen::Vector2d> hull =
        points.size() < 4 * kStrips ? std::vector<Eigen::Vector2d>() : innerHull(points, strips);
    if (hull.size() < 3) {
        for (const auto& p : points) keep(p);
        return kept;
    }
    kept = hull;
    // The narrowest extent of the hull over each strip: points within it are inside the hull.
    const auto outlineAt = [&](double x) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const auto& a = hull[i];
            const auto& b = hull[(i + 1) % hull.size()];
            if (std::min(a.x(), b.x()) > x || std::max(a.x(), b.x()) < x) continue;
            const double t = a.x() == b.x() ? 0.0 : (x - a.x()) / (b.x() - a.x());
            const double y = a.y() + t * (b.y() - a.y());
            low = std::min(low, y);
            high = std::max(high, y);
        }
        return std::pair(low, high);
    };
    std::array<std::pair<double, double>, kStrips> inside;
    auto before = outlineAt(strips.edge(0));
    for (std::size_t i = 0; i < kStrips; ++i) {
        const auto after = outlineAt(strips.edge(i + 1));
        inside[i] = {std::max(before.first, after.first), std::min(before.second, after.second)};
        before = after;
    }
    for (const auto& p : points) {
        const auto [lower, upper] = inside[strips.at(p.x())];
        const auto y = static_cast<double>(p.y());
        if (y <= lower || y >= upper) keep(p);
    }
    return kept;
}

struct PlanRectangle {
    double yaw = 0.0;
    Eigen::Vector2d low = Eigen::Vector2d::Zero();  // in the rotated frame
    Eigen::Vector2d high = Eigen::Vector2d::Zero();
    [[nodiscard]] double area() const { return (high - low).prod(); }
};

PlanRectangle rectangleAt(const std::vector<Eigen::Vector2d>& hull, double yaw) {
    const Eigen::Vector2d x(std::cos(yaw), std::sin(yaw));
    const Eigen::Vector2d y(-x.y(), x.x());
    PlanRectangle r{yaw, Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()),
                    Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity())};
    for (const auto& p : hull) {
        const Eigen::Vector2d q(p.dot(x), p.dot(y));
        r.low = r.low.cwiseMin(q);
        r.high = r.high.cwiseMax(q);
    }
    return r;
}

}  // namespace

OrientedBox fitUprightBox(std::span<const Eigen::Vector3f> points, double snap_share) {
    OrientedBox box;
    if (points.empty()) return box;
    Eigen::AlignedBox3f bounds;
    for (const auto& p : points) bounds.extend(p);
    const std::vector<Eigen::Vector2d> hull = convexHull(planCandidates(points, bounds));

    // The smallest rectangle has a side along an edge of the hull.
    const PlanRectangle aligned = rectangleAt(hull, 0.0);
    PlanRectangle best = aligned;
    constexpr double kQuarter = std::numbers::pi / 2.0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
        if (edge.squaredNorm() == 0.0) continue;
        double yaw = std::atan2(edge.y(), edge.x());
        yaw -= kQuarter * std::round(yaw / kQuarter);
        const PlanRectangle r = rectangleAt(hull, yaw);
        // Degenerate rectangles of lines all have an area of 0; of these the one with the smaller
        // perimeter is better.
        const double gain = best.area() - r.area();
        const double shorter = (best.high - best.low).sum() - (r.high - r.low).sum();
        if (gain > 1e-12 || (gain > -1e-12 && shorter > 1e-9)) best = r;
    }
    const double length = (aligned.high - aligned.low).sum();
    const bool as_good = aligned.area() <= best.area() * (1.0 + snap_share) + 1e-10 &&
                         length <= (best.high - best.low).sum() * (1.0 + snap_share) + 1e-6;
    if (as_good) best = aligned;

    const Eigen::Vector2d middle =
        Eigen::Rotation2Dd(best.yaw) * Eigen::Vector2d(0.5 * (best.low + best.high));
    const double bottom = bounds.min().z();
    const double top = bounds.max().z();
    box.yaw = best.yaw;
    box.center = {middle.x(), middle.y(), 0.5 * (bottom + top)};
    box.half_size = {0.5 * (best.high.x() - best.low.x()), 0.5 * (best.high.y() - best.low.y()),
                     0.5 * (top - bottom)};
    return box;
}

}  // namespace dollytrack
