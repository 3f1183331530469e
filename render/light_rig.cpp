#include "render/light_rig.h"

#include "engine/scene/labels.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>

namespace dollytrack::render {
namespace {

constexpr double kLampSpacing = 3.6;  // m; a lamp lights about its room's height around itself
constexpr double kBelowCeiling = 0.25;
constexpr double kFromWall = 1.0;      // m; kLampShade and the largest lamp's radius
constexpr double kShadesBeyond = 0.5;  // m; eaves and what else stands out a little

/// Under the ceiling that is really there: boxes of rooms include beams and the roof.
double lampHeight(const RayCaster& rays, const Eigen::AlignedBox3d& room, double x, double y) {
    const double start = room.min().z() + std::min(1.6, 0.6 * room.sizes().z());
    const RayHit up = rays.cast({x, y, start}, Eigen::Vector3d::UnitZ(), 12.0);
    const double ceiling =
        up.object_id != 0 ? start + up.distance : std::min(room.max().z(), room.min().z() + 3.0);
    return std::max(ceiling - kBelowCeiling, start + 0.2 * (ceiling - start));
}

/// The lamp of the scene that hangs near the place, if there is one.
const Object* hungNear(const Scene& scene, const Eigen::AlignedBox3d& room,
                       const Eigen::Vector2d& place) {
    const Object* nearest = nullptr;
    double distance = kLampSpacing / 3.0;
    // One on a wall lights the room from its middle: what is so near hides nothing of a lamp.
    Eigen::AlignedBox3d middle = room;
    middle.min().head<2>().array() += kFromWall;
    middle.max().head<2>().array() -= kFromWall;
    for (const Object& object : scene.objects) {
        const Eigen::Vector3d& center = object.box.center;
        if (object.nyu40 != kNyuLamp || !middle.contains(center)) continue;
        if (center.z() < room.center().z()) continue;  // stands on something
        const double away = (center.head<2>() - place).norm();
        if (away >= distance) continue;
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
    std::vector<bool> taken(scene.objects.size(), false);  // lamps that are a room's
    for (const Eigen::AlignedBox3d& room : boxes) {
        if (room.isEmpty()) continue;
        const Eigen::Vector3d size = room.sizes();
        // Grounds and streets can make a "room" of a hundred metres; it gets a bounded number.
        const int across = std::clamp(static_cast<int>(std::lround(size.x() / kLampSpacing)), 1, 6);
        const int along = std::clamp(static_cast<int>(std::lround(size.y() / kLampSpacing)), 1, 6);
        for (int i = 0; i < across; ++i) {
            for (int j = 0; j < along; ++j) {
                Lamp lamp;
                Eigen::Vector2d at(room.min().x() + (i + 0.5) / across * size.x(),
                                   room.min().y() + (j + 0.5) / along * size.y());
                if (const Object* hangs = hungNear(scene, room, at)) {
                    at = hangs->box.center.head<2>();
                    taken[static_cast<std::size_t>(hangs->id) - 1] = true;
                }
                lamp.position = {at.x(), at.y(), lampHeight(rays, room, at.x(), at.y())};
                lamp.radius_m = std::clamp(0.12 * std::min(size.x(), size.y()), 0.15, 0.6);
                rig.lamps.push_back(lamp);
            }
        }
    }
    if (light.own_lamps > 0.0F) rig.own_lamps = findOwnLamps(scene, rays, taken);
    for (OwnLamp& lamp : rig.own_lamps) lamp.intensity *= light.own_lamps;
    rig.sun.shades = scene.room_bounds;
    rig.sun.shades.min().array() -= kShadesBeyond;
    rig.sun.shades.max().array() += kShadesBeyond;
    setLight(rig, light);
    return rig;
}

}  // namespace dollytrack::render
