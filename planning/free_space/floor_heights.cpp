#include "planning/free_space/floor_heights.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/labels.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::planning {
namespace {

constexpr double kLevel = 0.5;  // least |z| of the normal: stairs and ramps count, walls do not
constexpr int kMostSurfaces = 256;
constexpr double kApart_m = 0.001;

enum class Ground { None, Floor, Wall };

Ground groundAt(const Scene& scene, const RayHit& hit) {
    const Object& object = scene.object(hit.object_id);
    if (!object.structure || object.nyu40 == kNyuDoor || object.nyu40 == kNyuWindow) {
        return Ground::None;
    }
    const Triangle& t = scene.triangles[hit.triangle];
    const Eigen::Vector3f& a = scene.positions[t[0]];
    const Eigen::Vector3f normal =
        (scene.positions[t[1]] - a).cross(scene.positions[t[2]] - a).normalized();
    if (std::abs(normal.z()) <= kLevel) return Ground::None;
    const bool wall = object.nyu40 == kNyuWall || object.nyu40 == kNyuCeiling;
    return wall ? Ground::Wall : Ground::Floor;
}

}  // namespace

int ColumnGrid::columnOf(const Eigen::Vector3d& place) const {
    const int x = static_cast<int>(std::floor((place.x() - origin.x()) / cell_m));
    const int y = static_cast<int>(std::floor((place.y() - origin.y()) / cell_m));
    return x < 0 || y < 0 || x >= columns_x || y >= columns_y ? -1 : y * columns_x + x;
}

Eigen::Vector2d ColumnGrid::centreOf(std::size_t column) const {
    const auto width = static_cast<std::size_t>(columns_x);
    return origin + cell_m * Eigen::Vector2d(static_cast<double>(column % width) + 0.5,
                                             static_cast<double>(column / width) + 0.5);
}

FloorHeights::FloorHeights(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                           double camera_radius_m)
    : grid_{free_space.bounds().min().head<2>(), free_space.resolution_m()} {
    const Eigen::Vector3d size = free_space.bounds().sizes();
    grid_.columns_x = static_cast<int>(std::lround(size.x() / grid_.cell_m));
    grid_.columns_y = static_cast<int>(std::lround(size.y() / grid_.cell_m));
    for (const Room& room : free_space.rooms()) {
        // Centre of the lowest cell where the sphere fits, minus the sphere's radius. The map's
        // lowest cells may lie below the building.
        const double height = room.box.min().z() + 0.5 * grid_.cell_m - camera_radius_m;
        rooms_.push_back({room.box, std::max(height, scene.room_bounds.min().z())});
    }
    floors_.resize(grid_.size());
    std::vector<bool> is_over_a_room(grid_.size());
    for (std::size_t room = 0; room < rooms_.size(); ++room) {
        for (const std::size_t i : columnsOver(room)) is_over_a_room[i] = true;
    }
    const double top = free_space.bounds().max().z();
    const double depth = size.z() + 1.0;
    parallelRanges(floors_.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!is_over_a_room[i]) continue;
            const Eigen::Vector2d at = grid_.centreOf(i);
            const Eigen::Vector3d from(at.x(), at.y(), top);
            double reached = 0.0;
            std::vector<float> of_walls;
            for (int k = 0; k < kMostSurfaces; ++k) {
                const RayHit hit = rays.cast(from, -Eigen::Vector3d::UnitZ(), depth, reached);
                if (hit.object_id == 0) break;
                const Ground ground = groundAt(scene, hit);
                const auto height = static_cast<float>(top - hit.distance);
                if (ground == Ground::Floor) floors_[i].push_back(height);
                if (ground == Ground::Wall) of_walls.push_back(height);
                reached = hit.distance + kApart_m;
            }
            if (floors_[i].empty()) floors_[i] = std::move(of_walls);
            std::reverse(floors_[i].begin(), floors_[i].end());
        }
    });
    // All rooms are judged by what is modelled, before floors are added.
    std::vector<std::size_t> without_floor;
    for (std::size_t room = 0; room < rooms_.size(); ++room) {
        if (!hasFloor(free_space, room)) without_floor.push_back(room);
    }
    for (const std::size_t room : without_floor) addLevelFloor(room);
}

/// The columns whose centre lies over the room's box or within a cell of it.
std::vector<std::size_t> FloorHeights::columnsOver(std::size_t room) const {
    const Eigen::AlignedBox3d& box = rooms_[room].box;
    const auto cells = [&](const Eigen::Vector3d& corner) -> Eigen::Array2d {
        return (corner.head<2>() - grid_.origin).array() / grid_.cell_m - 0.5;
    };
    const Eigen::Array2i count(grid_.columns_x, grid_.columns_y);
    const Eigen::Array2i first = (cells(box.min()) - 1.0).ceil().cast<int>().max(0);
    const Eigen::Array2i last = (cells(box.max()) + 1.0).floor().cast<int>().min(count - 1);
    std::vector<std::size_t> columns;
    for (int y = first.y(); y <= last.y(); ++y) {
        for (int x = first.x(); x <= last.x(); ++x) {
            columns.push_back(static_cast<std::size_t>(y) *
                                  static_cast<std::size_t>(grid_.columns_x) +
                              static_cast<std::size_t>(x));
        }
    }
    return columns;
}

/// Whether half of the room's columns or more have a surface below the free space.
bool FloorHeights::hasFloor(const FreeSpace& free_space, std::size_t room) const {
    const Eigen::AlignedBox3d& box = rooms_[room].box;
    std::size_t columns = 0;
    std::size_t columns_with_floor = 0;
    for (const std::size_t i : columnsOver(room)) {
        const Eigen::Vector2d at = grid_.centreOf(i);
        Eigen::Vector3d lowest(at.x(), at.y(), box.min().z() + 0.5 * grid_.cell_m);
        while (lowest.z() < box.max().z() &&
               free_space.componentAt(lowest) != static_cast<int>(room)) {
            lowest.z() += grid_.cell_m;
        }
        if (lowest.z() >= box.max().z()) continue;
        ++columns;
        if (!floors_[i].empty() && floors_[i].front() <= lowest.z()) ++columns_with_floor;
    }
    return 2 * columns_with_floor >= columns;
}

/// Adds a floor in all columns over the room without a lower surface, also under walls and
/// furniture, because FloorLevels treats the edge of a floor as an obstacle.
void FloorHeights::addLevelFloor(std::size_t room) {
    const auto height = static_cast<float>(rooms_[room].height);
    for (const std::size_t i : columnsOver(room)) {
        if (!floors_[i].empty() && floors_[i].front() <= height) continue;
        floors_[i].insert(floors_[i].begin(), height);
    }
}

double FloorHeights::roomFloor(const Eigen::Vector3d& place) const {
    double height = std::numeric_limits<double>::lowest();
    for (const RoomFloor& room : rooms_) {
        const bool above = place.z() >= room.height &&
                           (place.head<2>().array() >= room.box.min().head<2>().array()).all() &&
                           (place.head<2>().array() <= room.box.max().head<2>().array()).all();
        if (above) height = std::max(height, room.height);
    }
    return height == std::numeric_limits<double>::lowest() ? rooms_.front().height : height;
}

FloorHeights::Span FloorHeights::below(const Eigen::AlignedBox3d& places) const {
    const auto column = [&](double at, double origin, int count) {
        return std::clamp(static_cast<int>(std::floor((at - origin) / grid_.cell_m)), 0, count - 1);
    };
    const int x0 = column(places.min().x(), grid_.origin.x(), grid_.columns_x);
    const int x1 = column(places.max().x(), grid_.origin.x(), grid_.columns_x);
    const int y0 = column(places.min().y(), grid_.origin.y(), grid_.columns_y);
    const int y1 = column(places.max().y(), grid_.origin.y(), grid_.columns_y);
    const auto low = static_cast<float>(places.min().z());
    const auto high = static_cast<float>(places.max().z());
    Span span{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const std::vector<float>& floors =
                floors_[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.columns_x) +
                        static_cast<std::size_t>(x)];
            const auto above_low = std::upper_bound(floors.begin(), floors.end(), low);
            const auto above_high = std::upper_bound(above_low, floors.end(), high);
            if (above_high == floors.begin()) continue;
            // From the floor below the lowest position to the one below the highest.
            const auto first = above_low == floors.begin() ? above_low : above_low - 1;
            span.lowest = std::min(span.lowest, static_cast<double>(*first));
            span.highest = std::max(span.highest, static_cast<double>(*(above_high - 1)));
        }
    }
    if (span.lowest > span.highest) {
        span.lowest = span.highest = roomFloor(places.min());
    }
    return span;
}

}  // namespace dollytrack::planning
