#include "planning/motions/walked_rooms.h"

#include "planning/collision/mapped_scene.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/floor_heights.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/motion_check.h"
#include "planning/rooms/room_plan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace dollytrack::planning {
namespace {

using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;

constexpr double kSameLevel = 0.2;      // floors this near to each other are one level, m
constexpr double kSimilarStorey = 0.6;  // a level with this share of the largest level's columns

/// The rooms in the order of a walk through their doorways, and back where it branches, as points
/// at one height, from the largest room on. `end` counts the points up to the last new room.
void visitRooms(const RoomPlan& plan, std::size_t room, double z, std::vector<char>& visited,
                Positions& points, std::size_t& end) {
    const auto atHeight = [&](Vector3d point) {
        point.z() = z;
        return point;
    };
    visited[room] = 1;
    const Vector3d middle = atHeight(plan.rooms()[room].box.center());
    points.push_back(middle);
    end = points.size();
    for (const Doorway& door : plan.doorways()) {
        const auto a = static_cast<std::size_t>(door.room_a);
        const auto b = static_cast<std::size_t>(door.room_b);
        if (a != room && b != room) continue;
        const std::size_t next = a == room ? b : a;
        if (visited[next]) continue;
        if (points.back() != middle) points.push_back(middle);
        points.push_back(atHeight(door.center));
        visitRooms(plan, next, z, visited, points, end);
        points.push_back(atHeight(door.center));
    }
}

}  // namespace

double commonLevel(std::vector<double> heights, double least_share) {
    std::ranges::sort(heights);
    const auto endOf = [&](std::size_t first) {
        return static_cast<std::size_t>(
            std::ranges::upper_bound(heights, heights[first] + kSameLevel) - heights.begin());
    };
    std::size_t most = 0;
    for (std::size_t i = 0; i < heights.size(); ++i) most = std::max(most, endOf(i) - i);
    std::size_t first = 0;
    while (static_cast<double>(endOf(first) - first) < least_share * static_cast<double>(most)) {
        ++first;
    }
    return heights[(first + endOf(first)) / 2];
}

double walkedFloor(const MappedScene& scene, const FloorHeights& floors, double height_m) {
    // Without the limits of the camera's height, which may exclude this one.
    const SweptSphere sphere(*scene.rays, *scene.free_space, scene.sphere->radius());
    std::vector<double> all;
    std::vector<double> walked;
    const ColumnGrid& grid = floors.grid();
    for (std::size_t column = 0; column < grid.size(); ++column) {
        const Eigen::Vector2d centre = grid.centreOf(column);
        for (const float floor : floors.at(column)) {
            const Vector3d place(centre.x(), centre.y(), floor + height_m);
            const bool stands_on_it = std::abs(floors.below(place) - floor) < 1e-3;
            all.push_back(floor);
            if (stands_on_it && sphere.fits(place)) walked.push_back(floor);
        }
    }
    if (all.empty()) return scene.scene->room_bounds.min().z();
    return commonLevel(walked.empty() ? all : walked, kSimilarStorey);
}

Positions walkedRooms(const MappedScene& scene, double z, const JobContext& job) {
    Positions corners;
    const RoomPlan plan(*scene.scene, *scene.rays, *scene.free_space, scene.sphere->radius());
    if (plan.rooms().empty()) return {};
    std::vector<char> visited(plan.rooms().size(), 0);
    std::size_t end = 0;
    visitRooms(plan, 0, z, visited, corners, end);
    corners.resize(end);
    if (corners.size() < 2) corners = {plan.rooms()[0].near_end, plan.rooms()[0].far_end};
    for (Vector3d& corner : corners) {
        if (job.cancelled()) return {};
        corner.z() = z;
        if (!scene.sphere->fits(corner)) corner = nearestFree(scene, corner).value_or(corner);
    }
    return corners;
}

}  // namespace dollytrack::planning
