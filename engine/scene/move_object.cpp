#include "engine/scene/move_object.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace dollytrack {
namespace {

bool sameParts(const Object& a, const Object& b) {
    return a.first_triangle == b.first_triangle && a.triangle_count == b.triangle_count &&
           a.first_vertex == b.first_vertex && a.vertex_count == b.vertex_count &&
           a.structure == b.structure;
}

/// Compares bits, not values: NaN equals NaN, and -0 differs from 0, because it may be in another
/// cell of a grid.
bool samePositions(const Scene& a, const Scene& b, const Object& object) {
    return std::memcmp(a.positions.data() + object.first_vertex,
                       b.positions.data() + object.first_vertex,
                       object.vertex_count * sizeof(Eigen::Vector3f)) == 0;
}

}  // namespace

Eigen::Vector3d turnLevel(const Eigen::Vector3d& vector, double turn_rad) {
    if (turn_rad == 0.0) return vector;
    const double c = std::cos(turn_rad);
    const double s = std::sin(turn_rad);
    return {c * vector.x() - s * vector.y(), s * vector.x() + c * vector.y(), vector.z()};
}

void moveObject(Scene& scene, int object_id, const Eigen::Vector3d& offset_m, double turn_rad) {
    Object& object = scene.objects[object_id - 1];
    const Eigen::Vector3d middle = object.box.center;
    const auto put = [&](const Eigen::Vector3d& point) -> Eigen::Vector3d {
        if (turn_rad == 0.0) return point + offset_m;
        return turnLevel(point - middle, turn_rad) + middle + offset_m;
    };
    for (std::uint32_t v = object.first_vertex; v < object.first_vertex + object.vertex_count;
         ++v) {
        scene.positions[v] = put(scene.positions[v].cast<double>()).cast<float>();
        if (v < scene.normals.size()) {
            scene.normals[v] = turnLevel(scene.normals[v].cast<double>(), turn_rad).cast<float>();
        }
    }
    object.box.center = middle + offset_m;
    object.box.yaw = std::remainder(object.box.yaw + turn_rad, 2.0 * std::numbers::pi);
    object.centroid = put(object.centroid);
    object.front = turnLevel(object.front, turn_rad);
}

Eigen::AlignedBox3d cornerBox(const Scene& scene, int object_id) {
    const Object& object = scene.object(object_id);
    Eigen::AlignedBox3d box;
    for (std::uint32_t v = 0; v < object.vertex_count; ++v) {
        box.extend(scene.positions[object.first_vertex + v].cast<double>());
    }
    return box;
}

std::optional<std::vector<int>> movedObjects(const Scene& before, const Scene& after) {
    if (before.objects.size() != after.objects.size() ||
        before.positions.size() != after.positions.size() ||
        before.room_bounds.min() != after.room_bounds.min() ||
        before.room_bounds.max() != after.room_bounds.max() ||
        before.source_from_world.matrix() != after.source_from_world.matrix() ||
        before.triangles != after.triangles) {
        return std::nullopt;
    }
    std::vector<int> moved;
    for (std::size_t i = 0; i < after.objects.size(); ++i) {
        if (!sameParts(before.objects[i], after.objects[i])) return std::nullopt;
        if (!samePositions(before, after, after.objects[i]) ||
            !(before.objects[i].box == after.objects[i].box)) {
            moved.push_back(after.objects[i].id);
        }
    }
    return moved;
}

}  // namespace dollytrack
