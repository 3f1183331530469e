#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace dollytrack::render {

/// A lamp: a flat round area that shines downwards, from every direction equally bright. Nothing
/// in the scene belongs to it: cameras do not see it, and light passes through it.
struct Lamp {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // of its middle, m
    double radius_m = 0.4;
    double intensity = 1.0;  // irradiance straight below at 1 m

    [[nodiscard]] double area() const;      // m2
    [[nodiscard]] double radiance() const;  // seen from below
};

/// Around a lamp, m, nothing casts a shadow: the shade of a real one that hangs where ours is must
/// not darken the room.
constexpr double kLampShade = 0.4;

/// Emission is in no unit that files agree on, and brighter than this only in a few.
constexpr float kBrightestEmission = 8.0F;

/// What lights a scene, in whichever way it is drawn. Files rarely bring lights, so rooms get their
/// own. Radiance is in units of the lamps' intensity.
struct LightRig {
    std::vector<Lamp> lamps;
    Eigen::Vector3f lamp_color = {1.0F, 0.93F, 0.83F};  // linear; warm
    Eigen::Vector3f sky_color = {0.80F, 0.93F, 1.15F};  // through windows and open sides; cool
    double sky_strength = 0.8;
    double ground_share = 0.3;    // of the sky's light is thrown back from below the horizon
    double emission_scale = 1.0;  // of the materials' emission

    /// What comes along this way, from outside towards -way; a unit vector.
    [[nodiscard]] Eigen::Vector3f skyRadiance(const Eigen::Vector3d& way) const;
    [[nodiscard]] Eigen::Vector3f emissionOf(const Material& material) const {
        return material.emission.cwiseMin(kBrightestEmission) * static_cast<float>(emission_scale);
    }
};

/// Whether the sky shines through this object, whatever its panes are made of in the file: rooms
/// are closed by windows that hide the outside, or have no outside at all.
[[nodiscard]] bool sendsDaylight(const Object& object);

/// One lamp under the middle of each room's ceiling, more in large rooms; where a lamp of the scene
/// hangs near such a place, under that. `rooms` are the boxes of the rooms; when it is empty the
/// scene's room_bounds is the one room.
[[nodiscard]] LightRig makeLightRig(const Scene& scene, const RayCaster& rays,
                                    std::span<const Eigen::AlignedBox3d> rooms = {});

}  // namespace dollytrack::render
