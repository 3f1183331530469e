#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace dollytrack::render {

/// A lamp: a round area that shines downwards.
struct Lamp {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // of its middle, m
    double radius_m = 0.4;
    double intensity = 1.0;  // irradiance straight below at 1 m
};

/// What lights a scene. Files rarely bring lights, so rooms get their own.
struct LightRig {
    std::vector<Lamp> lamps;
    Eigen::Vector3f lamp_color = {1.0F, 0.93F, 0.83F};  // linear; warm
    Eigen::Vector3f sky_color = {0.80F, 0.93F, 1.15F};  // through windows and open sides; cool
    double sky_strength = 0.8;
};

/// One lamp under the middle of each room's ceiling, more in large rooms. `rooms` are the boxes of
/// the rooms; when it is empty the scene's room_bounds is the one room.
[[nodiscard]] LightRig makeLightRig(const Scene& scene, const RayCaster& rays,
                                    std::span<const Eigen::AlignedBox3d> rooms = {});

}  // namespace dollytrack::render
