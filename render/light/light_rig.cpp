#include "render/light/light_rig.h"

#include "engine/scene/labels.h"
#include "render/light/ray_distance.h"
#include "render/light/unlit_areas.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace dollytrack::render {
namespace {

constexpr double kLampSpacing = 3.6;  // m; a lamp lights about a room's height around itself
constexpr double kBelowCeiling = 0.25;
constexpr double kFromWall = 1.0;  // m; kLampShade plus the largest lamp radius
constexpr std::size_t kMostPerPoint = 16;
constexpr double kShadesBeyond = 0.5;  // m; margin for eaves and other small overhangs

/// Height just below the actual ceiling or a hanging lamp; at most kHighestLamp_m. Room boxes may
/// include beams and the roof, and cupboards may hang over the position.
double lampHeight(const Scene& scene, const RayCaster& rays, const Eigen::AlignedBox3d& room,
                  const Eigen::Vector2d& at) {
    constexpr double kFar = 12.0;
    const double start = room.min().z() + std::min(1.6, 0.6 * room.sizes().z());
    const auto toFirst = [&](auto&& counts) {
        return distanceTo(scene, rays, {at.x(), at.y(), start}, Eigen::Vector3d::UnitZ(), kFar,
                          counts);
    };
    double up =
        toFirst([](const Object& object) { return object.structure || object.nyu40 == kNyuLamp; });
    if (up >= kFar) up = toFirst([](const Object&) { return true; });
    const double ceiling = up < kFar ? start + up : std::min(room.max().z(), room.min().z() + 3.0);
    const double below = std::max(ceiling - kBelowCeiling, start + 0.2 * (ceiling - start));
    return std::min(below, room.min().z() + kHighestLamp_m);
}

/// Shortest and longest horizontal distance to obstacles, m, at most kFromWall. Lamps are ignored,
/// because the position may be inside one.
std::pair<double, double> reachAround(const Scene& scene, const RayCaster& rays,
                                      const Eigen::Vector3d& place) {
    constexpr int kWays = 16;
    const auto other = [](const Object& object) { return object.nyu40 != kNyuLamp; };
    double shortest = kFromWall;
    double longest = 0.0;
    for (int k = 0; k < kWays; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kWays;
        const Eigen::Vector3d way(std::cos(angle), std::sin(angle), 0.0);
        const double distance = distanceTo(scene, rays, place, way, kFromWall, other);
        shortest = std::min(shortest, distance);
        longest = std::max(longest, distance);
    }
    return {shortest, longest};
}

double clearAround(const Scene& scene, const RayCaster& rays, const Eigen::Vector3d& place) {
    return reachAround(scene, rays, place).first;
}

/// A lamp at the wanted position or, if walls or cupboards would cut it, at the nearest of some
/// surrounding positions with enough space.
Lamp roomLamp(const Scene& scene, const RayCaster& rays, const Eigen::AlignedBox3d& room,
              const Eigen::Vector2d& wanted) {
    constexpr int kRings = 4;
    constexpr double kApart = 0.35;  // m
    constexpr double kAside = 0.05;  // m; distance kept from obstacles
    constexpr double kSmallest = 0.15;
    const Eigen::Vector3d size = room.sizes();
    const double radius = std::clamp(0.12 * std::min(size.x(), size.y()), kSmallest, 0.6);
    constexpr double kInWall = 0.1;   // m; inside a wall, positions on either side are allowed
    constexpr double kWithin = 0.75;  // m; a smaller enclosed space is no room
    Lamp best;
    double most = -1.0;
    const auto behindWall = [&](const Eigen::Vector3d& place) {
        const Eigen::Vector3d from(wanted.x(), wanted.y(), place.z());
        const double far = (place - from).norm();
        return distanceTo(scene, rays, from, (place - from) / far, far,
                          [](const Object& object) { return object.structure; }) < far;
    };
    for (int ring = 0; ring <= kRings && most < radius + kAside; ++ring) {
        const int places = ring == 0 ? 1 : 8;
        for (int k = 0; k < places && most < radius + kAside; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / places;
            const Eigen::Vector2d at =
                wanted + ring * kApart * Eigen::Vector2d(std::cos(angle), std::sin(angle));
            const Eigen::Vector3d place(at.x(), at.y(), lampHeight(scene, rays, room, at));
            if (ring > 0 && !room.contains(place)) continue;
            if (ring > 0 && most > kInWall && behindWall(place)) continue;
            const auto [clear, longest] = reachAround(scene, rays, place);
            // Inside a column or a cupboard a lamp would light nothing else.
            if (clear <= most || longest < kWithin) continue;
            most = clear;
            best.position = place;
        }
    }
    if (most < 0.0) best.position << wanted, lampHeight(scene, rays, room, wanted);
    best.radius_m = std::clamp(most - kAside, kSmallest, radius);
    return best;
}

/// The scene lamp that hangs nearest to the position, away from walls and cupboards; null if none.
const Object* hungNear(const Scene& scene, const RayCaster& rays, const Eigen::AlignedBox3d& room,
                       const Eigen::Vector2d& place) {
    const Object* nearest = nullptr;
    double distance = kLampSpacing / 3.0;
    // A wall lamp is replaced by one in the room's middle, because the wall blocks half its light.
    Eigen::AlignedBox3d middle = room;
    middle.min().head<2>().array() += kFromWall;
    middle.max().head<2>().array() -= kFromWall;
    for (const Object& object : scene.objects) {
        const Eigen::Vector3d& center = object.box.center;
        if (object.nyu40 != kNyuLamp || !middle.contains(center)) continue;
        if (center.z() < room.center().z()) continue;  // stands on something
        const double away = (center.head<2>() - place).norm();
        if (away >= distance || clearAround(scene, rays, center) < kFromWall) continue;
        distance = away;
        nearest = &object;
    }
    return nearest;
}

}  // namespace

double Lamp::area() const {
    return std::numbers::pi * radius_m * radius_m;
}

double Lamp::radiance() const {
    return intensity * (1.0 + radius_m * radius_m) / area();
}

Eigen::Vector3f LightRig::skyRadiance(const Eigen::Vector3d& way) const {
    const double strength = way.z() > -0.05 ? sky_strength : ground_share * sky_strength;
    return (sky_color * static_cast<float>(strength)).cwiseProduct(sky_factor);
}

bool sendsDaylight(const Object& object) {
    return object.nyu40 == kNyuWindow;
}

std::vector<bool> showsOutside(const Scene& scene) {
    std::vector<bool> outside;
    for (const Object& object : scene.objects) {
        bool is_sky = false;
        std::string word;
        for (const char c : object.name + " ") {
            if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
                word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
                continue;
            }
            for (const char* known : {"sky", "skybox", "skydome", "skysphere"}) {
                is_sky = is_sky || word == known;
            }
            word.clear();
        }
        outside.push_back(sendsDaylight(object) || (object.structure && is_sky));
    }
    return outside;
}

void setLight(LightRig& rig, const ResolvedLight& light) {
    rig.lamp_color = light.lamp_color.value_or(LightRig{}.lamp_color);
    rig.lamp_factor = rig.emission_factor = light.lamp_factor;
    rig.sky_factor = light.sky_factor;
    rig.backdrop_factor = light.backdrop_factor;
    rig.backdrop_grey = light.backdrop_grey;
    rig.exposure_ev = light.exposure_ev;
    rig.sun.way = light.to_sun;
    rig.sun.irradiance = light.sun_irradiance;
}

LightRig makeLightRig(const Scene& scene, const RayCaster& rays,
                      std::span<const Eigen::AlignedBox3d> rooms, const ResolvedLight& light) {
    std::vector<Eigen::AlignedBox3d> boxes(rooms.begin(), rooms.end());
    if (boxes.empty()) boxes.push_back(scene.room_bounds);
    LightRig rig;
    std::vector<bool> taken(scene.objects.size(), false);  // lamps that mark a room lamp's position
    for (const Eigen::AlignedBox3d& room : boxes) {
        if (room.isEmpty()) continue;
        const Eigen::Vector3d size = room.sizes();
        // Grounds and streets can form a "room" of a hundred metres, so the number is bounded.
        const int across = std::clamp(static_cast<int>(std::lround(size.x() / kLampSpacing)), 1, 6);
        const int along = std::clamp(static_cast<int>(std::lround(size.y() / kLampSpacing)), 1, 6);
        const auto lamps = static_cast<std::size_t>(across * along);
        rig.lamps_per_point = std::clamp(lamps, rig.lamps_per_point, kMostPerPoint);
        for (int i = 0; i < across; ++i) {
            for (int j = 0; j < along; ++j) {
                Eigen::Vector2d at(room.min().x() + (i + 0.5) / across * size.x(),
                                   room.min().y() + (j + 0.5) / along * size.y());
                if (const Object* hangs = hungNear(scene, rays, room, at)) {
                    at = hangs->box.center.head<2>();
                    taken[hangs->id - 1] = true;
                }
                rig.lamps.push_back(roomLamp(scene, rays, room, at));
            }
        }
    }
    const std::vector<Lamp> more = lampsForUnlitAreas(scene, rays, boxes, rig.lamps);
    rig.lamps.insert(rig.lamps.end(), more.begin(), more.end());
    if (light.own_lamps > 0.0F) rig.scene_lamps = findSceneLamps(scene, rays, taken);
    for (SceneLamp& lamp : rig.scene_lamps) lamp.intensity *= light.own_lamps;
    rig.sun.shades = scene.room_bounds;
    rig.sun.shades.min().array() -= kShadesBeyond;
    rig.sun.shades.max().array() += kShadesBeyond;
    setLight(rig, light);
    return rig;
}

}  // namespace dollytrack::render
