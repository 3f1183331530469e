#include "render/draw/storey_cutaway.h"

#include "engine/scene/labels.h"
#include "engine/scene/storeys.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::render {
namespace {

/// Rooms with at least a fifth of the widest room's floor area. Smaller ones are the insides of
/// cupboards or hollows below the floor.
std::vector<Eigen::AlignedBox3d> largeOf(std::span<const Eigen::AlignedBox3d> rooms) {
    const auto area = [](const Eigen::AlignedBox3d& room) {
        return room.sizes().x() * room.sizes().y();
    };
    double widest = 0.0;
    for (const Eigen::AlignedBox3d& room : rooms) widest = std::max(widest, area(room));
    std::vector<Eigen::AlignedBox3d> large;
    for (const Eigen::AlignedBox3d& room : rooms) {
        if (area(room) >= 0.2 * widest) large.push_back(room);
    }
    return large;
}

}  // namespace

std::vector<bool> hidesRooms(const Scene& scene) {
    std::vector<bool> hidden(scene.objects.size() + 1, false);
    const double building = scene.room_bounds.sizes().head<2>().norm();
    for (const Object& object : scene.objects) {
        if (!object.structure) continue;
        const double across = 2.0 * object.box.half_size.head<2>().norm();
        hidden[object.id] = object.nyu40 == kNyuCeiling || across > 1.5 * building;
    }
    return hidden;
}

Eigen::AlignedBox3d buildingOf(const Scene& scene, std::span<const Eigen::AlignedBox3d> rooms) {
    constexpr double kWall = 0.25;  // m
    Eigen::AlignedBox3d building;
    for (const Eigen::AlignedBox3d& room : rooms) building.extend(room);
    if (building.isEmpty()) return scene.room_bounds;
    const Eigen::Vector3d wall(kWall, kWall, kWall);
    return scene.room_bounds.intersection(
        Eigen::AlignedBox3d(building.min() - wall, building.max() + wall));
}

double floorOf(const Scene& scene, std::span<const Eigen::AlignedBox3d> rooms) {
    if (rooms.empty()) return lowestFloor(scene);
    double floor = std::numeric_limits<double>::infinity();
    for (const Eigen::AlignedBox3d& room : largeOf(rooms)) floor = std::min(floor, room.min().z());
    return floor;
}

double ceilingOf(const Scene& scene, std::span<const Eigen::AlignedBox3d> rooms) {
    constexpr double kStorey = 1.0;  // m: rooms whose floors differ by less are on one storey
    const std::vector<Eigen::AlignedBox3d> large = largeOf(rooms);
    double top_floor = -std::numeric_limits<double>::infinity();
    for (const Eigen::AlignedBox3d& room : large) top_floor = std::max(top_floor, room.min().z());
    double ceiling = scene.room_bounds.max().z() + 1.0;
    for (const Eigen::AlignedBox3d& room : large) {
        if (room.min().z() > top_floor - kStorey) ceiling = std::min(ceiling, room.max().z());
    }
    return ceiling;
}

std::vector<StoreyView> storeysOf(const Scene& scene, std::span<const Eigen::AlignedBox3d> rooms) {
    constexpr double kFlushLamp = 0.2;  // m: lamps mounted on the ceiling begin less than this
                                        // above it
    constexpr double kSlabEdge = 0.02;
    constexpr double kRug = 0.05;
    const std::vector<FloorLevel> floors =
        rooms.empty() ? labelledFloors(scene) : floorsBelow(scene, rooms);
    const double top_ceiling = ceilingOf(scene, rooms);
    const StoreyView top{floorOf(scene, rooms), top_ceiling, top_ceiling + kFlushLamp};
    if (floors.size() < 2) return {top};
    std::vector<StoreyView> storeys;
    for (std::size_t i = 0; i + 1 < floors.size(); ++i) {
        storeys.push_back(
            {floors[i].top_m, floors[i + 1].underside_m - kSlabEdge, floors[i + 1].top_m - kRug});
    }
    storeys.push_back({floors.back().top_m, top.ceiling_z, top.hidden_from_z});
    return storeys;
}

std::vector<bool> hiddenFor(const Scene& scene, const StoreyView& storey) {
    std::vector<bool> hidden = hidesRooms(scene);
    for (const Object& object : scene.objects) {
        if (object.box.center.z() - object.box.half_size.z() < storey.hidden_from_z) continue;
        hidden[object.id] = true;
    }
    return hidden;
}

Eigen::AlignedBox3d withinStorey(const Eigen::AlignedBox3d& building, const StoreyView& storey) {
    constexpr double kAboveCeiling = 0.35;  // m: a room's free space ends this far below its
                                            // ceiling, and a wall's top this far above it
    Eigen::AlignedBox3d within = building;
    within.min().z() = std::max(building.min().z(), storey.floor_z - 0.25);
    within.max().z() = std::min(building.max().z(), storey.ceiling_z + kAboveCeiling);
    return within.isEmpty() ? building : within;
}

StructureCut cutTowards(const Eigen::AlignedBox3d& building, double floor_z, double ceiling_z,
                        const Eigen::Vector3d& aside) {
    const double height = std::max(building.sizes().z(), 0.5);
    const double half_depth = 0.5 * (std::abs(aside.x()) * building.sizes().x() +
                                     std::abs(aside.y()) * building.sizes().y());
    const double slope = 0.95 * height / std::max(0.75 * half_depth, 0.1);
    StructureCut cut;
    cut.plane.head<3>() = Eigen::Vector3d(0, 0, 1) + slope * aside;
    Eigen::Vector3d full_height = building.center() - 0.3 * half_depth * aside;
    full_height.z() = building.max().z() - 0.04;
    cut.plane.w() = cut.plane.head<3>().dot(full_height);
    cut.keep_below_z = floor_z + 0.12;
    cut.ceiling_z = ceiling_z;
    return cut;
}

bool isCutAway(const View& view, const Scene& scene, int object_id, const Eigen::Vector3d& at) {
    const std::size_t index = object_id;
    if (index < view.hidden.size() && view.hidden[index]) return true;
    if (view.clip_box && !view.clip_box->contains(at)) return true;
    if (!view.structure_cut || !scene.object(object_id).structure) return false;
    const StructureCut& cut = *view.structure_cut;
    return at.z() > cut.ceiling_z ||
           (cut.plane.head<3>().dot(at) > cut.plane.w() && at.z() > cut.keep_below_z);
}

}  // namespace dollytrack::render
