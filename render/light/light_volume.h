#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "render/light/light_rig.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace dollytrack::render {

/// How finely the light is computed. Plain data.
struct LightVolumeParams {
    double cell_m = 0.08;      // wanted; grows where the scene would need more than max_cells
    int max_cells = 400'000;   // bounds time and memory
    int rays_per_cell = 24;    // as cells share what these find, see LightCells::blur
    int bounces = 20;          // at most; in dark rooms light settles before
    bool limit_slopes = true;  // see limited(); not of a part of a light, as the others dilute it
};

/// Light in the air of a scene on a regular grid, x fastest: what the lamps send, with soft
/// shadows, and what surfaces, windows and emitting things send from all around, in spherical
/// harmonics of order 1 (Ramamoorthi & Hanrahan 2001): in colour the mean, its slope in brightness.
struct LightVolume {
    Eigen::Vector3d low = Eigen::Vector3d::Zero();  // corner of the grid; cell centres are inside
    double cell_m = 0.0;
    std::array<int, 3> cells = {0, 0, 0};
    std::vector<Eigen::Vector3f> ambient;  // irradiance from all around, linear RGB
    /// How that changes with the direction a surface faces: ambient * (1 + slope . normal).
    std::vector<Eigen::Vector3f> slope;
    std::vector<Eigen::Vector3f> lamps;  // irradiance vector: sum of strength * direction to it
    Eigen::Vector3f lamp_color = Eigen::Vector3f::Ones();
    /// How much of `lamps` is of the scene's own, which have another colour; empty: nothing.
    std::vector<float> own_share;
    Eigen::Vector3f own_color = Eigen::Vector3f::Ones();
    float dimmed = 1.0F;    // sky and emission, to this share of the rig's; see balanced()
    float exposure = 1.0F;  // brings a white surface in the middle of the rooms to light grey
    // Of emission that is seen, beside `dimmed`; see showsOutside().
    float lamps_shine = 1.0F;
    float outside_shines = 1.0F;
    Eigen::Vector3f backdrop_factor = Eigen::Vector3f::Ones();  // of the sky that is seen
    float backdrop_grey = 0.0F;                                 // see skyBackdrop()
    SunLight sun;  // what falls straight in is in none of the above but what it throws back

    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * cells[1] + y) * cells[0] + x;
    }
};

/// No longer than 0.75. Light from one half of the world has a slope of 1; in cells half outside a
/// window, thin things would have black sides with it.
[[nodiscard]] Eigen::Vector3f limited(const Eigen::Vector3f& slope);

/// How strong the rig's lights are, of what is not in the cells.
void setStrengths(const LightRig& rig, LightVolume& volume);

/// The rig as the volume was lit by: files give emission in any unit, and a house without a roof
/// would be all cool daylight, so both are dimmed where they would drown the lamps.
[[nodiscard]] LightRig balanced(LightRig rig, const LightVolume& volume);

/// Computed by ray casting on all threads; the result does not depend on their number. Empty when
/// cancelled.
[[nodiscard]] LightVolume bakeLightVolume(const Scene& scene, const RayCaster& rays,
                                          const LightRig& rig, const LightVolumeParams& params = {},
                                          const JobContext& job = {});

}  // namespace dollytrack::render
