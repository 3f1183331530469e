#include "engine/scene/outside_objects.h"

#include "engine/scene/labels.h"
#include "engine/scene/room_bounds.h"

#include <algorithm>

namespace dollytrack {
namespace {

constexpr double kLeastBuilding_m = 2.0;  // per direction; less is a shelf or a single wall
constexpr double kRoomHeight_m = 1.8;
constexpr double kTouch_m = 0.02;

/// The box around walls and ceilings; floors are ignored, because they may be ground that extends
/// outside.
Eigen::AlignedBox3d boxOfBuilding(const Scene& scene) {
    Eigen::AlignedBox3d walls;
    Eigen::AlignedBox3d all;
    for (const Object& object : scene.objects) {
        if (!object.structure) continue;
        const Eigen::AlignedBox3d box = worldBounds(object.box);
        if (object.nyu40 == kNyuWall) walls.extend(box);
        if (object.nyu40 == kNyuWall || object.nyu40 == kNyuCeiling) all.extend(box);
    }
    const bool is_building = !walls.isEmpty() &&
                             walls.sizes().head<2>().minCoeff() >= kLeastBuilding_m &&
                             walls.sizes().z() >= kRoomHeight_m;
    return is_building ? all : Eigen::AlignedBox3d();
}

}  // namespace

std::vector<int> findOutsideObjects(const Scene& scene) {
    const Eigen::AlignedBox3d building = boxOfBuilding(scene);
    if (building.isEmpty()) return {};
    std::vector<int> outside;
    std::size_t targets = 0;
    for (const Object& object : scene.objects) {
        if (object.role != Role::Target) continue;
        ++targets;
        const Eigen::AlignedBox3d box = worldBounds(object.box);
        const Eigen::Vector2d low = building.min().head<2>().array() + kTouch_m;
        const Eigen::Vector2d high = building.max().head<2>().array() - kTouch_m;
        const bool beside = (box.max().head<2>().array() < low.array()).any() ||
                            (box.min().head<2>().array() > high.array()).any();
        if (beside || box.min().z() > building.max().z() - kTouch_m) outside.push_back(object.id);
    }
    // If most targets are outside, the walls are not those of a building.
    if (2 * outside.size() > targets) outside.clear();
    return outside;
}

}  // namespace dollytrack
