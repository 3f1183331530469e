#include "planning/rooms/room_plan.h"

#include "engine/core/disjoint_sets.h"
#include "planning/free_space/column_flood.h"
#include "planning/free_space/floor_heights.h"
#include "planning/free_space/floor_plan.h"
#include "planning/free_space/voxelize.h"
#include "planning/rooms/room_borders.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::planning {
namespace {

constexpr double kWidestGap_m = 1.8;  // of a doorway, between walls
constexpr double kWidestLintel_m = 3.0;
constexpr double kLeastRoom_m2 = 0.8;  // area to walk in
constexpr double kCorridorWidth_m = 1.8;
constexpr double kCorridorShape = 2.5;  // length over width

/// Area over which the camera can move, by part, m2.
std::vector<double> walkedAreas(const VoxelGrid& plane, const FloorPlan& plan,
                                const FreeColumns& free_columns) {
    std::vector<double> area(plan.parts, 0.0);
    for (std::size_t i = 0; i < plan.part_of_column.size(); ++i) {
        const int part = plan.part_of_column[i];
        if (part == kNoPart || free_columns.walks[i] == 0) continue;
        area[part] += plane.resolution_m * plane.resolution_m;
    }
    return area;
}

/// Merges parts too small for a room (a threshold, the corner behind a door, outside a window) into
/// their neighbours, then assigns all other columns, walkable ones first.
void fillPlan(const VoxelGrid& plane, const FreeColumns& free_columns, FloorPlan& plan) {
    const std::vector<double> area = walkedAreas(plane, plan, free_columns);
    std::vector<int>& parts = plan.part_of_column;
    for (int& part : parts) {
        if (part != kNoPart && area[part] < kLeastRoom_m2) part = kNoPart;
    }
    spread(plane, parts, [&](std::size_t i) { return free_columns.walks[i] != 0; });
    spread(plane, parts, [](std::size_t) { return true; });
}

/// Sets whether a room is a corridor, and the ends of its longer axis.
void judgeShape(PlanRoom& room, const std::vector<Eigen::Vector2d>& places) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& place : places) mean += place;
    mean /= static_cast<double>(places.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const auto& place : places) spread += (place - mean) * (place - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    const Eigen::Vector2d along = axes.eigenvectors().col(1);
    double low = 0.0;
    double high = 0.0;
    for (const auto& place : places) {
        low = std::min(low, along.dot(place - mean));
        high = std::max(high, along.dot(place - mean));
    }
    const double length = high - low;
    const double width = length > 0.0 ? room.area_m2 / length : 0.0;
    room.corridor = length >= kCorridorShape * width && width <= kCorridorWidth_m;
    const double height = room.box.center().z();
    const Eigen::Vector2d near_end = mean + low * along;
    const Eigen::Vector2d far_end = mean + high * along;
    room.near_end = {near_end.x(), near_end.y(), height};
    room.far_end = {far_end.x(), far_end.y(), height};
}

/// Whether most of a border lies under a lintel, in columns that the floor plan counts as wall.
bool isUnderLintel(const RoomBorder& border, const std::vector<int>& drawn) {
    const auto in_wall = std::count_if(border.columns.begin(), border.columns.end(),
                                       [&](std::size_t i) { return drawn[i] == kNoPart; });
    return 2 * in_wall >= static_cast<std::ptrdiff_t>(border.columns.size());
}

/// Merges parts across borders too wide for a doorway until none is left. Returns the other
/// borders. `drawn` is the plan with its walls.
std::vector<RoomBorder> joinRooms(const VoxelGrid& plane, const FreeColumns& free_columns,
                                  const std::vector<int>& drawn, FloorPlan& plan) {
    while (true) {
        DisjointSets<int> joined(static_cast<std::size_t>(plan.parts));
        std::vector<RoomBorder> doorways;
        bool done = true;
        for (RoomBorder& border : findBorders(plane, plan.part_of_column, free_columns)) {
            const double width = widthOf(border, plane);
            if (width <= (isUnderLintel(border, drawn) ? kWidestLintel_m : kWidestGap_m)) {
                doorways.push_back(std::move(border));
                continue;
            }
            joined.join(border.a, border.b);
            done = false;
        }
        if (done) return doorways;
        // Two separate borders may become one when their parts are merged.
        for (int& part : plan.part_of_column) {
            if (part != kNoPart) part = joined.find(part);
        }
    }
}

/// The room number of each part, by walkable area, the largest first; 0 for parts merged into
/// others.
std::vector<int> numberRooms(const VoxelGrid& plane, const FreeColumns& free_columns,
                             const FloorPlan& plan) {
    const std::vector<double> area = walkedAreas(plane, plan, free_columns);
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t part = 0; part < area.size(); ++part) {
        if (area[part] > 0.0) order.emplace_back(-area[part], part);
    }
    std::sort(order.begin(), order.end());
    std::vector<int> room_of_part(area.size(), 0);
    for (std::size_t i = 0; i < order.size(); ++i) {
        room_of_part[order[i].second] = static_cast<int>(i);
    }
    return room_of_part;
}

Doorway doorwayAt(const RoomBorder& border, const VoxelGrid& plane,
                  const FreeColumns& free_columns) {
    Doorway doorway;
    const std::size_t middle = middleOf(border, plane);
    const int column = static_cast<int>(middle);
    doorway.center = plane.centerOf(column % plane.count[0], column / plane.count[0], 0);
    doorway.center.z() = 0.5 * (free_columns.low[middle] + free_columns.high[middle]);
    doorway.width_m = widthOf(border, plane);
    if (border.through.norm() > 1e-9) {
        const Eigen::Vector2d through = border.through.normalized();
        doorway.through = {through.x(), through.y(), 0.0};
    }
    return doorway;
}

}  // namespace

RoomPlan::RoomPlan(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                   double camera_radius_m) {
    const VoxelGrid grid = makeVoxelGrid(scene.room_bounds, free_space.resolution_m(),
                                         std::numeric_limits<std::size_t>::max());
    FloorPlan plan = drawFloorPlan(grid, voxelize(scene, grid, {}).cells);
    plane_ = grid;
    plane_.first[2] = 0;
    plane_.count[2] = 1;
    const std::vector<int> drawn = plan.part_of_column;
    const FreeColumns free_columns = freeColumnsOver(
        grid, drawn, free_space, FloorHeights(scene, rays, free_space, camera_radius_m));
    fillPlan(plane_, free_columns, plan);
    const std::vector<RoomBorder> borders = joinRooms(plane_, free_columns, drawn, plan);
    const std::vector<int> room_of_part = numberRooms(plane_, free_columns, plan);
    const auto roomOf = [&](int part) { return room_of_part[part]; };
    takeRooms(free_columns, plan.part_of_column, room_of_part);
    for (const RoomBorder& border : borders) {
        Doorway doorway = doorwayAt(border, plane_, free_columns);
        doorway.room_a = roomOf(border.a);
        doorway.room_b = roomOf(border.b);
        doorways_.push_back(doorway);
    }
}

void RoomPlan::takeRooms(const FreeColumns& free_columns, const std::vector<int>& parts,
                         const std::vector<int>& room_of_part) {
    rooms_.resize(1);
    for (const int room : room_of_part) {
        rooms_.resize(std::max(rooms_.size(), static_cast<std::size_t>(room) + 1));
    }
    room_of_column_.assign(plane_.size(), 0);
    std::vector<std::vector<Eigen::Vector2d>> places(rooms_.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i] == kNoPart) continue;
        room_of_column_[i] = room_of_part[parts[i]];
        if (free_columns.fits[i] == 0) continue;
        PlanRoom& room = rooms_[room_of_column_[i]];
        const int column = static_cast<int>(i);
        const Eigen::Vector3d at =
            plane_.centerOf(column % plane_.count[0], column / plane_.count[0], 0);
        room.box.extend(Eigen::Vector3d(at.x(), at.y(), free_columns.low[i]));
        room.box.extend(Eigen::Vector3d(at.x(), at.y(), free_columns.high[i]));
        room.area_m2 += plane_.resolution_m * plane_.resolution_m;
        places[room_of_column_[i]].emplace_back(at.x(), at.y());
    }
    for (std::size_t i = 0; i < rooms_.size(); ++i) {
        if (!places[i].empty()) judgeShape(rooms_[i], places[i]);
        rooms_[i].name = (rooms_[i].corridor ? "corridor_" : "room_") + std::to_string(i + 1);
    }
}

int RoomPlan::roomAt(const Eigen::Vector3d& place) const {
    std::array<int, 3> at = {};
    const Eigen::Vector3d level(place.x(), place.y(), 0.5 * plane_.resolution_m);
    return plane_.find(level, at) ? room_of_column_[plane_.indexOf(at[0], at[1], 0)] : 0;
}

bool RoomPlan::inOneRoom(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                         const Eigen::Vector3d& end, Eigen::Vector3d& where) const {
    const int room = roomAt(start);
    // Upper bound of the curve's speed |B'(t)|.
    const double speed = 2.0 * std::max((control - start).norm(), (end - control).norm());
    const int steps = std::max(1, static_cast<int>(std::ceil(speed / (0.5 * plane_.resolution_m))));
    for (int i = 1; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        where = (1.0 - t) * (1.0 - t) * start + 2.0 * (1.0 - t) * t * control + t * t * end;
        if (roomAt(where) != room) return false;
    }
    return true;
}

}  // namespace dollytrack::planning
