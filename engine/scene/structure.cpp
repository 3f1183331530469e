#include "engine/scene/structure.h"

#include "engine/scene/labels.h"
#include "engine/scene/room_bounds.h"

#include <algorithm>
#include <cmath>

namespace dollytrack {
namespace {

/// How an object's surface is spread over directions and heights.
struct Shape {
    Eigen::AlignedBox3d bounds;
    double area = 0.0;
    double level_area = 0.0;     // faces up or down
    double upright_area = 0.0;   // faces sideways
    double largest_plane = 0.0;  // upright area that faces along the box's thin side
};

Shape measureShape(const Scene& scene, const Object& object) {
    Shape shape;
    shape.bounds = worldBounds(object.box);
    const double turn = object.box.half_size.x() < object.box.half_size.y()
                            ? object.box.yaw
                            : object.box.yaw + 0.5 * 3.14159265358979;
    const Eigen::Vector3d thin(std::cos(turn), std::sin(turn), 0.0);
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        const Triangle& t = scene.triangles[object.first_triangle + i];
        const Eigen::Vector3d a = scene.positions[t[0]].cast<double>();
        const Eigen::Vector3d normal = (scene.positions[t[1]].cast<double>() - a)
                                           .cross(scene.positions[t[2]].cast<double>() - a);
        const double length = normal.norm();
        shape.area += 0.5 * length;
        if (std::abs(normal.z()) > 0.97 * length) shape.level_area += 0.5 * length;
        if (std::abs(normal.z()) < 0.2 * length) shape.upright_area += 0.5 * length;
        if (std::abs(normal.dot(thin)) > 0.97 * length) shape.largest_plane += 0.5 * length;
    }
    return shape;
}

struct Verdict {
    bool is_structure = false;
    int nyu40 = 0;
};

Verdict judge(const Shape& shape, const Object& object, const Eigen::AlignedBox3d& room) {
    const Eigen::Vector3d size = shape.bounds.sizes();
    const Eigen::Vector3d room_size = room.sizes();
    const double covers_x = size.x() / std::max(1e-9, room_size.x());
    const double covers_y = size.y() / std::max(1e-9, room_size.y());
    const double low = shape.bounds.min().z() - room.min().z();
    const double high = room.max().z() - shape.bounds.max().z();
    const bool flat = size.z() < 0.4 && shape.level_area > 0.4 * shape.area;

    if (covers_x > 1.3 && covers_y > 1.3) {
        return {true, flat && low < 0.5 ? int{kNyuFloor} : int{kNyuOtherStructure}};
    }
    const double share = object.box.half_size.x() * object.box.half_size.y() * 4.0 /
                         std::max(1e-9, room_size.x() * room_size.y());
    if (flat && share > 0.3) {
        if (high < 0.3 * room_size.z() && low > 1.8) return {true, kNyuCeiling};
        if (low < 0.3) return {true, kNyuFloor};
    }
    // A shell holds the whole room: its walls at least, often floor and ceiling too.
    if (covers_x > 0.85 && covers_y > 0.85 && size.z() > 0.6 * room_size.z()) {
        return {true, kNyuWall};
    }
    // A rim around the room: skirting, cornice, rails.
    if (covers_x > 0.85 && covers_y > 0.85 && (low < 0.3 || high < 0.5)) {
        return {true, kNyuOtherStructure};
    }
    const double thickness = 2.0 * std::min(object.box.half_size.x(), object.box.half_size.y());
    const double length = 2.0 * std::max(object.box.half_size.x(), object.box.half_size.y());
    const bool tall = size.z() > 0.75 * room_size.z() && size.z() > 1.8 && low < 0.3;
    if (tall && thickness < 0.35 && length > 0.8 && shape.largest_plane > 0.6 * shape.area) {
        return {true, kNyuWall};
    }
    // Narrow strips of wall beside and above doors, and columns, reach from floor to ceiling.
    if (tall && high < 0.1 && shape.upright_area > 0.7 * shape.area &&
        object.triangle_count <= 64) {
        return {true, kNyuWall};
    }
    return {};
}

}  // namespace

void recogniseStructure(Scene& scene, const std::vector<bool>& undecided) {
    const Eigen::AlignedBox3d room = findRoomBounds(scene.objects);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        if (!undecided[i]) continue;
        Object& object = scene.objects[i];
        const Verdict verdict = judge(measureShape(scene, object), object, room);
        if (!verdict.is_structure) continue;
        object.role = Role::Structure;
        object.nyu40 = verdict.nyu40;
    }
}

}  // namespace dollytrack
