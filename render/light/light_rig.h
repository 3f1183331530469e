#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/resolved_light.h"
#include "engine/scene/scene.h"
#include "render/light/own_lamps.h"

#include <Eigen/Geometry>

#include <array>
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

/// Of the scene's own lamps beside the others: shades and their bulbs are warmer, as 3500 K is
/// beside 4500 K.
constexpr std::array<float, 3> kOwnTint = {1.10F, 0.99F, 0.80F};

/// The sun: a small disc, infinitely far away. Its light falls through windows and open sides.
struct SunLight {
    Eigen::Vector3d way = Eigen::Vector3d::UnitZ();        // to its middle, unit vector
    Eigen::Vector3f irradiance = Eigen::Vector3f::Zero();  // of what faces it; linear RGB
    /// What lies outside casts no shadow: grounds, skies and what else is not the building.
    Eigen::AlignedBox3d shades;

    [[nodiscard]] bool shines() const { return irradiance.maxCoeff() > 0.0F; }
};

/// Sine of the angle between the sun's middle and its edge.
constexpr double kSunRadius = 0.00465;

/// What lights a scene, in whichever way it is drawn. Files rarely bring lights, so rooms get their
/// own. Radiance is in units of the lamps' intensity.
struct LightRig {
    std::vector<Lamp> lamps;
    std::vector<OwnLamp> own_lamps;
    Eigen::Vector3f lamp_color = {1.0F, 0.93F, 0.83F};  // linear; warm
    Eigen::Vector3f sky_color = {0.80F, 0.93F, 1.15F};  // through windows and open sides; cool
    double sky_strength = 0.8;
    double ground_share = 0.3;    // of the sky's light is thrown back from below the horizon
    double emission_scale = 1.0;  // of the materials' emission

    // What the time of day and the user's wishes change of it, see ResolvedLight.
    float lamp_factor = 1.0F;
    float emission_factor = 1.0F;  // of what else shines by itself
    Eigen::Vector3f sky_factor = Eigen::Vector3f::Ones();
    Eigen::Vector3f backdrop_factor = Eigen::Vector3f::Ones();
    float backdrop_grey = 0.0F;  // see skyBackdrop()
    double exposure_ev = 0.0;
    SunLight sun;

    /// Of a thing's own emission; see showsOutside().
    [[nodiscard]] float shineFactor(bool shows_outside) const {
        return shows_outside ? sky_factor.mean() : emission_factor;
    }
    /// The lamps' colour and strength.
    [[nodiscard]] Eigen::Vector3f lampLight() const { return lamp_color * lamp_factor; }
    /// The same of the scene's own.
    [[nodiscard]] Eigen::Vector3f ownLampLight() const {
        return lampLight().cwiseProduct(Eigen::Vector3f(kOwnTint[0], kOwnTint[1], kOwnTint[2]));
    }

    /// What comes along this way, from outside towards -way; a unit vector.
    [[nodiscard]] Eigen::Vector3f skyRadiance(const Eigen::Vector3d& way) const;
    /// Of emission as the file has it, before shineFactor().
    [[nodiscard]] Eigen::Vector3f emissionOf(const Eigen::Vector3f& emission) const {
        return emission.cwiseMin(kBrightestEmission) * static_cast<float>(emission_scale);
    }
};

/// Whether the sky shines through this object, whatever its panes are made of in the file: rooms
/// are closed by windows that hide the outside, or have no outside at all.
[[nodiscard]] bool sendsDaylight(const Object& object);

/// Objects that show the day outside, by id - 1: windows, and pictures of a sky that stand behind
/// them. What these shine with goes with the sky, and the sun passes them.
[[nodiscard]] std::vector<bool> showsOutside(const Scene& scene);

/// Sets all that `light` says but own_lamps.
void setLight(LightRig& rig, const ResolvedLight& light);

/// One lamp under the middle of each room's ceiling, more in large rooms; where a lamp of the scene
/// hangs near such a place, under that. All other lamps of the scene are its own_lamps. `rooms` are
/// the boxes of the rooms; when it is empty the scene's room_bounds is the one room. What `light`
/// says is done to all of it.
[[nodiscard]] LightRig makeLightRig(const Scene& scene, const RayCaster& rays,
                                    std::span<const Eigen::AlignedBox3d> rooms = {},
                                    const ResolvedLight& light = {});

}  // namespace dollytrack::render
