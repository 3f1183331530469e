#include "engine/scene/storeys.h"

#include "engine/scene/labels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

namespace dollytrack {
namespace {

constexpr double kStorey_m = 1.9;          // smallest distance between the floors of two storeys
constexpr double kStep_m = 0.05;           // height step of the histogram
constexpr double kStoreyFloorShare = 0.1;  // of the largest floor; excludes landings
constexpr float kLevelNormal = 0.98F;      // cosine of 11 degrees
constexpr double kHeadHeight_m = 1.0;      // height above a floor that must be free

using AreaAt = std::map<long, double>;  // area of level surfaces by height step

AreaAt levelAreas(const Scene& scene, const std::function<bool(const Object&)>& counts) {
    AreaAt area_at;
    for (const Object& object : scene.objects) {
        if (!object.structure || !counts(object)) continue;
        for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
            const Triangle& t = scene.triangles[object.first_triangle + i];
            const Eigen::Vector3d a = scene.positions[t[0]].cast<double>();
            const Eigen::Vector3d across = (scene.positions[t[1]].cast<double>() - a)
                                               .cross(scene.positions[t[2]].cast<double>() - a);
            if (std::abs(across.z()) < kLevelNormal * across.norm()) continue;
            area_at[std::lround(a.z() / kStep_m)] += 0.5 * std::abs(across.z());
        }
    }
    return area_at;
}

/// Floors at the heights with enough area; nearby surfaces above each other are one slab.
std::vector<FloorLevel> slabsOf(const AreaAt& area_at) {
    double largest = 0.0;
    for (const auto& [step, area] : area_at) largest = std::max(largest, area);
    std::vector<FloorLevel> floors;
    double last = -std::numeric_limits<double>::infinity();
    for (const auto& [step, area] : area_at) {
        const double height = kStep_m * static_cast<double>(step);
        if (area < kStoreyFloorShare * largest) continue;
        if (height - last >= kStorey_m) floors.push_back({height, height});
        floors.back().top_m = height;
        last = height;
    }
    return floors;
}

bool isWithinRooms(double height, std::span<const Eigen::AlignedBox3d> rooms) {
    return std::ranges::any_of(rooms, [&](const Eigen::AlignedBox3d& room) {
        return height > room.min().z() && height < room.max().z();
    });
}

}  // namespace

std::vector<FloorLevel> labelledFloors(const Scene& scene) {
    return slabsOf(
        levelAreas(scene, [](const Object& object) { return object.nyu40 == kNyuFloor; }));
}

std::vector<FloorLevel> floorsBelow(const Scene& scene,
                                    std::span<const Eigen::AlignedBox3d> rooms) {
    std::vector<FloorLevel> floors = slabsOf(
        levelAreas(scene, [](const Object& object) { return object.nyu40 != kNyuCeiling; }));
    std::erase_if(floors, [&](const FloorLevel& floor) {
        return !isWithinRooms(floor.top_m + kHeadHeight_m, rooms);
    });
    return floors;
}

double lowestFloor(const Scene& scene) {
    const std::vector<FloorLevel> floors = slabsOf(levelAreas(scene, [&](const Object& object) {
        return object.nyu40 != kNyuCeiling &&
               object.box.half_size.head<2>().norm() < scene.room_bounds.sizes().head<2>().norm();
    }));
    return floors.empty() ? scene.room_bounds.min().z() : floors.front().top_m;
}

}  // namespace dollytrack
