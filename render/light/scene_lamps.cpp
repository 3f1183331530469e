#include "render/light/scene_lamps.h"

#include "engine/scene/labels.h"
#include "render/light/ray_distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::render {
namespace {

constexpr double kSmallest = 0.03;  // radius of a ball, m
constexpr double kLargest = 0.12;
constexpr double kAround = 0.01;              // m; margin, because a round shade touches its box
constexpr double kSceneLampFromWall = 0.005;  // m; distance of the shade from walls, tables and
                                              // floors
constexpr double kLeast = 1e-3;               // m; smallest apparent radius
constexpr double kThinnest = 0.005;           // m; smallest half thickness of a shade between walls
constexpr double kLong = 0.12;                // m, half height: a longer hanging lamp has a cord
constexpr double kTouches = 0.06;  // m; an object this near counts as support or suspension

/// Position of the ball, depending on whether the lamp stands or hangs.
Eigen::Vector3d ballOf(const Scene& scene, const RayCaster& rays, const Object& object) {
    const OrientedBox& box = object.box;
    const auto other = [](const Object& hit) { return hit.nyu40 != kNyuLamp; };
    const double half = box.half_size.z();
    const auto touches = [&](double side) {
        const Eigen::Vector3d way = side * Eigen::Vector3d::UnitZ();
        const double far = half + kTouches;
        return distanceTo(scene, rays, box.center, way, far, other) < far;
    };
    Eigen::Vector3d place = box.center;
    if (touches(-1.0)) {
        place.z() += 2.0 / 3.0 * half;
    } else if (half > kLong && touches(1.0)) {
        place.z() -= 2.0 / 3.0 * half;
    }
    return place;
}

SceneLamp lampOf(const Scene& scene, const RayCaster& rays, const Object& object) {
    SceneLamp lamp;
    lamp.object_id = object.id;
    lamp.intensity = kSceneLampIntensity;
    lamp.position = ballOf(scene, rays, object);
    lamp.radius_m = std::clamp(0.6 * std::min(object.box.half_size.x(), object.box.half_size.y()),
                               kSmallest, kLargest);
    // Extends the shade from the ball to the box's sides or to walls; the ball is then moved
    // inside.
    const Eigen::Vector3d in_box = object.box.toBox(lamp.position);
    Eigen::Vector3d low;
    Eigen::Vector3d high;
    Eigen::Vector3d moved = in_box;
    const auto blocks = [](const Object& hit) { return hit.structure; };
    for (int axis = 0; axis < 3; ++axis) {
        std::array<double, 2> reach{};
        for (const int side : {0, 1}) {
            const double sign = side == 0 ? -1.0 : 1.0;
            const double wanted =
                std::max(object.box.half_size[axis] - sign * in_box[axis] + kAround, lamp.radius_m);
            const Eigen::Vector3d to =
                object.box.toWorld(in_box + sign * wanted * Eigen::Vector3d::Unit(axis));
            const Eigen::Vector3d way = (to - lamp.position).normalized();
            const double free = distanceTo(scene, rays, lamp.position, way, wanted, blocks);
            reach[side] = std::max(free < wanted ? free - kSceneLampFromWall : wanted, kThinnest);
            // A standing lamp rests on its box's floor; its light must not get below that.
            if (axis == 2 && side == 0) {
                reach[side] = std::max(std::min(reach[side], wanted - kAround - kSceneLampFromWall),
                                       kThinnest);
            }
        }
        low[axis] = in_box[axis] - reach[0];
        high[axis] = in_box[axis] + reach[1];
        // Centres the ball where it only just fits.
        lamp.radius_m = std::min(lamp.radius_m, 0.5 * (reach[0] + reach[1]));
        moved[axis] =
            std::min(std::max(in_box[axis], low[axis] + lamp.radius_m), high[axis] - lamp.radius_m);
    }
    lamp.position = object.box.toWorld(moved);
    lamp.shade = object.box;
    lamp.shade.center = object.box.toWorld(0.5 * (low + high));
    lamp.shade.half_size = 0.5 * (high - low);
    return lamp;
}

}  // namespace

double SceneLamp::radiusFrom(const Eigen::Vector3d& place) const {
    constexpr double kOutside = 0.7;  // share of the distance, which keeps points outside the ball
    return std::clamp(kOutside * (position - place).norm(), kLeast, radius_m);
}

double SceneLamp::radianceFrom(const Eigen::Vector3d& place) const {
    const double radius = radiusFrom(place);
    return intensity / (std::numbers::pi * radius * radius);
}

double SceneLamp::shadowedFor(const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                              double distance) const {
    const Eigen::Vector3d start = shade.toBox(from);
    const Eigen::Vector3d along = Eigen::AngleAxisd(-shade.yaw, Eigen::Vector3d::UnitZ()) * way;
    double enters = 0.0;
    double leaves = distance;
    for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0.0) {
            if (std::abs(start[axis]) > shade.half_size[axis]) return distance;
            continue;
        }
        const double middle = -start[axis] / along[axis];
        const double half = shade.half_size[axis] / std::abs(along[axis]);
        enters = std::max(enters, middle - half);
        leaves = std::min(leaves, middle + half);
    }
    return enters <= leaves ? enters : distance;
}

std::vector<SceneLamp> findSceneLamps(const Scene& scene, const RayCaster& rays,
                                      const std::vector<bool>& taken) {
    const auto isTaken = [&](const Object& object) { return taken[object.id - 1]; };
    std::vector<const Object*> found;
    std::vector<const Object*> wholes;  // lamps that others may be parts of
    for (const Object& object : scene.objects) {
        if (isTaken(object)) wholes.push_back(&object);
        if (object.nyu40 != kNyuLamp || isTaken(object)) continue;
        if (object.triangle_count == 0 || !scene.room_bounds.contains(object.box.center)) continue;
        found.push_back(&object);
    }
    std::stable_sort(found.begin(), found.end(), [](const Object* a, const Object* b) {
        return a->box.volume() > b->box.volume();
    });
    std::vector<SceneLamp> lamps;
    for (const Object* object : found) {
        // In some files bulbs and stands are separate objects.
        const bool is_part = std::ranges::any_of(wholes, [&](const Object* whole) {
            return whole->box.contains(object->box.center, kAround) ||
                   (isTaken(*whole) && object->box.contains(whole->box.center, kAround));
        });
        if (is_part) continue;
        wholes.push_back(object);
        lamps.push_back(lampOf(scene, rays, *object));
        if (lamps.size() == kMaxSceneLamps) break;
    }
    return lamps;
}

}  // namespace dollytrack::render
