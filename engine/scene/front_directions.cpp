#include "engine/scene/front_directions.h"

#include "engine/jobs/parallel.h"
#include "engine/scene/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace dollytrack {
namespace {

constexpr double kStandsAt = 0.25;  // m, gap of furniture at a wall, as at a skirting board
constexpr double kFarthest = 12.0;  // m: how far "the open" is looked for

/// An upright triangle of a wall: its line in plan, and its range of heights.
struct WallLine {
    Eigen::Vector2d a;
    Eigen::Vector2d b;
    double low;
    double high;
};

std::vector<WallLine> collectWalls(const Scene& scene) {
    std::vector<WallLine> walls;
    for (const Object& object : scene.objects) {
        if (!object.structure || object.nyu40 == kNyuFloor || object.nyu40 == kNyuCeiling) {
            continue;
        }
        for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
            const Triangle& t = scene.triangles[object.first_triangle + i];
            std::array<Eigen::Vector3d, 3> p;
            for (std::size_t k = 0; k < 3; ++k) p[k] = scene.positions[t[k]].cast<double>();
            const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
            if (std::abs(normal.z()) > 0.2 * normal.norm()) continue;
            const Eigen::Vector2d along = Eigen::Vector2d(-normal.y(), normal.x()).normalized();
            const auto [low, high] = std::minmax({p[0].z(), p[1].z(), p[2].z()});
            std::array<double, 3> s;
            for (std::size_t k = 0; k < 3; ++k) s[k] = along.dot((p[k] - p[0]).head<2>());
            const auto [first, last] = std::minmax({s[0], s[1], s[2]});
            if (last - first < 0.05 || high - low < 0.2) continue;
            walls.push_back(
                {p[0].head<2>() + first * along, p[0].head<2>() + last * along, low, high});
        }
    }
    return walls;
}

/// Distance from `from` along the unit direction to the first wall at the height of `from`.
double openDistance(const std::vector<WallLine>& walls, const Eigen::Vector3d& from,
                    const Eigen::Vector2d& direction) {
    double nearest = kFarthest;
    for (const WallLine& wall : walls) {
        if (from.z() < wall.low || from.z() > wall.high) continue;
        const Eigen::Vector2d line = wall.b - wall.a;
        const Eigen::Vector2d offset = wall.a - from.head<2>();
        const double across = direction.x() * line.y() - direction.y() * line.x();
        if (std::abs(across) < 1e-12) continue;
        const double t = (offset.x() * line.y() - offset.y() * line.x()) / across;
        const double u = (offset.x() * direction.y() - offset.y() * direction.x()) / across;
        if (t > 0.0 && t < nearest && u > -1e-6 && u < 1.0 + 1e-6) nearest = t;
    }
    return nearest;
}

struct Side {
    Eigen::Vector2d direction;  // outward normal
    double reach;               // distance from the centre to the side
    double length;              // of the side
};

std::array<Side, 4> sidesOf(const OrientedBox& box) {
    const Eigen::Vector2d x(std::cos(box.yaw), std::sin(box.yaw));
    const Eigen::Vector2d y(-x.y(), x.x());
    const double hx = box.half_size.x();
    const double hy = box.half_size.y();
    return {{{x, hx, 2.0 * hy}, {-x, hx, 2.0 * hy}, {y, hy, 2.0 * hx}, {-y, hy, 2.0 * hx}}};
}

/// The side that is against a wall; in a corner the longer one, such as a sofa's back.
std::optional<Side> sideAtWall(const std::vector<WallLine>& walls, const OrientedBox& box) {
    std::optional<Side> best;
    double best_score = 0.0;
    for (const Side& side : sidesOf(box)) {
        // Measured from the centre, because a picture may be in the plane of the wall.
        double gap = openDistance(walls, box.center, side.direction) - side.reach;
        if (gap > kStandsAt) {
            const Eigen::Vector2d along(-side.direction.y(), side.direction.x());
            for (const double share : {-0.3, 0.3}) {
                Eigen::Vector3d from = box.center;
                from.head<2>() += share * side.length * along;
                gap = std::min(gap, openDistance(walls, from, side.direction) - side.reach);
            }
        }
        if (gap > kStandsAt) continue;
        // The depth reduces the score, because both faces of an object thinner than kStandsAt are
        // "at" the wall.
        const double score = side.length - 0.5 * side.reach - 2.0 * std::max(0.0, gap);
        if (!best || score > best_score) {
            best = side;
            best_score = score;
        }
    }
    return best;
}

void faceTheOpen(const std::vector<WallLine>& walls, const Eigen::Vector3d& room_centre,
                 Object& object) {
    const OrientedBox& box = object.box;
    const double longer = std::max(box.half_size.x(), box.half_size.y());
    const double shorter = std::min(box.half_size.x(), box.half_size.y());
    if (longer > 1.25 * shorter) {
        const std::array<Side, 4> sides = sidesOf(box);
        const std::size_t first = box.half_size.x() < box.half_size.y() ? 0 : 2;
        const double ahead = openDistance(walls, box.center, sides[first].direction);
        const double behind = openDistance(walls, box.center, sides[first + 1].direction);
        Eigen::Vector2d direction = sides[first].direction;
        if (behind > ahead + 1e-6) {
            direction = sides[first + 1].direction;
        } else if (std::abs(behind - ahead) <= 1e-6 &&
                   direction.dot((room_centre - box.center).head<2>()) < 0.0) {
            direction = -direction;
        }
        object.front = {direction.x(), direction.y(), 0.0};
        object.front_source = FrontSource::ShortSide;
        return;
    }
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    constexpr int kRays = 32;
    for (int i = 0; i < kRays; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kRays;
        const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
        const double open = openDistance(walls, box.center, direction);
        if (open < kFarthest) sum += open * open * direction;
    }
    if (sum.norm() < 0.5) sum = (room_centre - box.center).head<2>();
    if (sum.norm() > 1e-9) {
        sum.normalize();
        object.front = {sum.x(), sum.y(), 0.0};
    }
    object.front_source = FrontSource::RoomCentre;
}

}  // namespace

void findFronts(Scene& scene) {
    const std::vector<WallLine> walls = collectWalls(scene);
    const Eigen::Vector3d room_centre = scene.room_bounds.center();
    parallelFor(scene.objects.size(), [&](std::size_t i) {
        Object& object = scene.objects[i];
        if (object.front_source == FrontSource::Annotation) return;
        if (const auto side = sideAtWall(walls, object.box)) {
            object.front = {-side->direction.x(), -side->direction.y(), 0.0};
            object.front_source = FrontSource::Wall;
            return;
        }
        faceTheOpen(walls, room_centre, object);
    });
}

}  // namespace dollytrack
