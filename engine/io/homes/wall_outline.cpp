#include "engine/io/homes/wall_outline.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace dollytrack::homes {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// The direction to the left of a direction, on a page whose y points down.
Vector2d leftOf(const Vector2d& direction) {
    return {direction.y(), -direction.x()};
}

/// Points on the wall's centre line from start to end, with the direction to the left at each.
struct LinePoint {
    Vector2d at;
    Vector2d left;
};

std::vector<LinePoint> middleLine(const HomeWall& wall) {
    const Vector2d chord = wall.end - wall.start;
    const double length = chord.norm();
    if (!(length > 1e-3)) return {};
    const double extent =
        std::clamp(wall.arc_extent, -1.99 * std::numbers::pi, 1.99 * std::numbers::pi);
    if (std::abs(extent) < 1e-3) {
        const Vector2d left = leftOf(chord / length);
        return {{wall.start, left}, {wall.end, left}};
    }
    // The arc's centre sees both ends under the angle arc_extent.
    const double to_centre = length / (2.0 * std::tan(extent / 2.0));
    const Vector2d centre = 0.5 * (wall.start + wall.end) - to_centre * leftOf(chord / length);
    const Vector2d arm = wall.start - centre;
    const int steps = std::max(2, static_cast<int>(std::ceil(std::abs(extent) / 0.131)));
    std::vector<LinePoint> points;
    for (int i = 0; i <= steps; ++i) {
        const Vector2d turned = Eigen::Rotation2Dd(extent * i / steps) * arm;
        points.push_back({centre + turned, turned.normalized() * (extent > 0.0 ? 1.0 : -1.0)});
    }
    return points;
}

std::vector<WallSegment> unjoined(const HomeWall& wall) {
    const std::vector<LinePoint> line = middleLine(wall);
    std::vector<WallSegment> segments;
    const double half = 0.5 * wall.thickness;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        WallSegment segment;
        segment.left_start = line[i].at + half * line[i].left;
        segment.right_start = line[i].at - half * line[i].left;
        segment.left_end = line[i + 1].at + half * line[i + 1].left;
        segment.right_end = line[i + 1].at - half * line[i + 1].left;
        const double count = static_cast<double>(line.size() - 1);
        segment.from = static_cast<double>(i) / count;
        segment.to = static_cast<double>(i + 1) / count;
        segments.push_back(segment);
    }
    return segments;
}

std::optional<Vector2d> meet(const Vector2d& a, const Vector2d& a_along, const Vector2d& b,
                             const Vector2d& b_along) {
    const double turn = cross(a_along, b_along);
    if (std::abs(turn) < 1e-3) return std::nullopt;
    return a + cross(b - a, b_along) / turn * a_along;
}

/// An end of a wall, for its neighbour.
struct WallEnd {
    const WallSegment* segment = nullptr;
    bool is_start = false;
};

std::optional<WallEnd> otherEnd(const std::vector<HomeWall>& walls,
                                const std::vector<std::vector<WallSegment>>& outlines,
                                std::size_t self, int neighbour, const Vector2d& corner) {
    if (neighbour < 0 || static_cast<std::size_t>(neighbour) == self) return std::nullopt;
    const HomeWall& other = walls[neighbour];
    const auto& outline = outlines[neighbour];
    if (outline.empty()) return std::nullopt;
    const bool by_start = other.at_start == static_cast<int>(self);
    const bool by_end = other.at_end == static_cast<int>(self);
    if (!by_start && !by_end) return std::nullopt;
    const bool start =
        by_start && (!by_end || (other.start - corner).norm() <= (other.end - corner).norm());
    return WallEnd{start ? &outline.front() : &outline.back(), start};
}

/// Moves a corner to the intersection of its side with the neighbour's side.
void join(const WallSegment& mine, bool at_start, const WallEnd& other, double reach,
          Vector2d& left, Vector2d& right) {
    const WallSegment& theirs = *other.segment;
    // If both walls start (or both end) at the corner, left and right are swapped.
    const bool crossed = at_start == other.is_start;
    const Vector2d& their_left = crossed ? theirs.right_start : theirs.left_start;
    const Vector2d& their_right = crossed ? theirs.left_start : theirs.right_start;
    const auto met_left = meet(mine.left_start, mine.along(), their_left, theirs.along());
    const auto met_right = meet(mine.right_start, mine.along(), their_right, theirs.along());
    if (met_left && (*met_left - left).norm() <= reach) left = *met_left;
    if (met_right && (*met_right - right).norm() <= reach) right = *met_right;
}

}  // namespace

Vector2d WallSegment::along() const {
    return (0.5 * (left_end + right_end) - 0.5 * (left_start + right_start)).normalized();
}

Vector2d WallSegment::leftward() const {
    return leftOf(along());
}

std::vector<std::vector<WallSegment>> wallOutlines(const std::vector<HomeWall>& walls) {
    std::vector<std::vector<WallSegment>> plain;
    plain.reserve(walls.size());
    for (const HomeWall& wall : walls) plain.push_back(unjoined(wall));
    std::vector<std::vector<WallSegment>> joined = plain;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const HomeWall& wall = walls[i];
        if (plain[i].empty()) continue;
        const auto reach = [&](int neighbour) {
            const HomeWall& other = walls[neighbour];
            return 2.0 * std::max(wall.thickness, other.thickness);
        };
        if (const auto other = otherEnd(walls, plain, i, wall.at_start, wall.start)) {
            WallSegment& first = joined[i].front();
            join(plain[i].front(), true, *other, reach(wall.at_start), first.left_start,
                 first.right_start);
        }
        if (const auto other = otherEnd(walls, plain, i, wall.at_end, wall.end)) {
            WallSegment& last = joined[i].back();
            join(plain[i].back(), false, *other, reach(wall.at_end), last.left_end, last.right_end);
        }
    }
    return joined;
}

}  // namespace dollytrack::homes
