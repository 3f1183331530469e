#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/resolved_light.h"
#include "engine/scene/scene.h"
#include "render/light/scene_lamps.h"

#include <Eigen/Geometry>

#include <array>
#include <span>
#include <vector>

namespace dollytrack::render {

/// A room lamp: a flat disc of uniform radiance that shines downwards. It is no object of the
/// scene: cameras do not see it, and light passes through it.
struct Lamp {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // centre, m
    double radius_m = 0.4;
    double intensity = 1.0;  // irradiance straight below at 1 m

    [[nodiscard]] double area() const;      // m2
    [[nodiscard]] double radiance() const;  // as seen from below
};

/// Distance from a lamp within which nothing casts its shadow, m: a real lamp's shade may hang
/// where the lamp is placed.
constexpr double kLampShade = 0.4;

/// Distance beyond which a lamp's light is neglected, m.
constexpr double kLampReach_m = 9.0;

/// Largest height of room lamps above the floor, m. It keeps the floor of a high hall within
/// kLampReach_m of the lamps.
constexpr double kHighestLamp_m = 5.0;

/// Emission is clamped to this, because files use no common unit; few exceed it.
constexpr float kBrightestEmission = 8.0F;

/// Tint of the scene's own lamps relative to room lamps: warmer, as 3500 K beside 4500 K.
constexpr std::array<float, 3> kSceneLampTint = {1.10F, 0.99F, 0.80F};

/// The sun: a small, infinitely distant disc. It shines through windows and open sides.
struct SunLight {
    Eigen::Vector3d way = Eigen::Vector3d::UnitZ();        // unit vector towards its centre
    Eigen::Vector3f irradiance = Eigen::Vector3f::Zero();  // on a surface facing it; linear RGB
    /// Objects outside this box cast no shadow: grounds, skies and whatever is not the building.
    Eigen::AlignedBox3d shades;

    [[nodiscard]] bool shines() const { return irradiance.maxCoeff() > 0.0F; }
};

/// Sine of the sun's angular radius.
constexpr double kSunRadius = 0.00465;

/// All light sources of a scene, for the rasteriser and the path tracer. Files rarely contain
/// lights, so rooms are given lamps. Radiance is in units of lamp intensity.
struct LightRig {
    std::vector<Lamp> lamps;
    std::vector<SceneLamp> scene_lamps;
    std::size_t lamps_per_point = 4;  // strongest room lamps, shadows ignored, that light a point
    Eigen::Vector3f lamp_color = {1.0F, 0.93F, 0.83F};  // linear; warm
    Eigen::Vector3f sky_color = {0.80F, 0.93F, 1.15F};  // through windows and open sides; cool
    double sky_strength = 0.8;
    double ground_share = 0.3;    // share of the sky's light that comes from below the horizon
    double emission_scale = 1.0;  // factor of the materials' emission

    // Factors from the time of day and the user's settings, see ResolvedLight.
    float lamp_factor = 1.0F;
    float emission_factor = 1.0F;  // for emission that does not show the outside
    Eigen::Vector3f sky_factor = Eigen::Vector3f::Ones();
    Eigen::Vector3f backdrop_factor = Eigen::Vector3f::Ones();
    float backdrop_grey = 0.0F;  // see skyBackdrop()
    double exposure_ev = 0.0;
    SunLight sun;

    /// Factor of an object's emission; see showsOutside().
    [[nodiscard]] float shineFactor(bool shows_outside) const {
        return shows_outside ? sky_factor.mean() : emission_factor;
    }
    /// Colour times strength of the room lamps.
    [[nodiscard]] Eigen::Vector3f lampLight() const { return lamp_color * lamp_factor; }
    /// Colour times strength of the scene's own lamps.
    [[nodiscard]] Eigen::Vector3f sceneLampLight() const {
        return lampLight().cwiseProduct(
            Eigen::Vector3f(kSceneLampTint[0], kSceneLampTint[1], kSceneLampTint[2]));
    }

    /// Sky radiance from the direction `way`, a unit vector.
    [[nodiscard]] Eigen::Vector3f skyRadiance(const Eigen::Vector3d& way) const;
    /// Clamped and scaled emission of a material, before shineFactor().
    [[nodiscard]] Eigen::Vector3f emissionOf(const Eigen::Vector3f& emission) const {
        return emission.cwiseMin(kBrightestEmission) * static_cast<float>(emission_scale);
    }
};

/// Whether an object counts as a window, which emits sky light whatever its material: in many files
/// windows hide the outside or there is none.
[[nodiscard]] bool sendsDaylight(const Object& object);

/// By id - 1: objects that show the outside, which are windows and sky backdrops (structure named
/// sky, skybox, skydome or skysphere). Their emission follows the sky's strength, and sunlight
/// passes through them.
[[nodiscard]] std::vector<bool> showsOutside(const Scene& scene);

/// Applies every setting of `light` except own_lamps.
void setLight(LightRig& rig, const ResolvedLight& light);

/// Places one lamp below the centre of each room's ceiling, several in large rooms, at most
/// kHighestLamp_m above the floor; a scene lamp that hangs nearby determines the horizontal
/// position. All other lamps of the scene become scene_lamps. Dark
/// parts get more lamps, see lampsForUnlitAreas(). `rooms` are room boxes; if there are none,
/// scene.room_bounds is used. Then `light` is applied.
[[nodiscard]] LightRig makeLightRig(const Scene& scene, const RayCaster& rays,
                                    std::span<const Eigen::AlignedBox3d> rooms = {},
                                    const ResolvedLight& light = {});

}  // namespace dollytrack::render
