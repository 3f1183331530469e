#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "render/light/light_rig.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace dollytrack::render {

/// Resolution and quality of the light volume.
struct LightVolumeParams {
    double cell_m = 0.08;      // wanted cell size; larger if there would be more than max_cells
                               // cells
    int max_cells = 400'000;   // bounds time and memory
    int rays_per_cell = 24;    // few, because cells share their results, see IrradianceGrid::blur()
    int bounces = 20;          // maximum; dark rooms converge earlier
    bool limit_slopes = true;  // see limited(); false for a part that is summed with others
};

/// Light in a scene's free space on a regular grid, x fastest: direct lamp light with soft shadows,
/// and ambient light from surfaces, windows and emitters in spherical harmonics of order 1
/// (Ramamoorthi & Hanrahan 2001). The mean is in colour, the slope in brightness only.
struct LightVolume {
    Eigen::Vector3d low = Eigen::Vector3d::Zero();  // corner of the grid; cell centres lie inside
    double cell_m = 0.0;
    std::array<int, 3> cells = {0, 0, 0};
    std::vector<Eigen::Vector3f> ambient;  // ambient irradiance, linear RGB
    /// Dependence on the surface's normal: irradiance is ambient * (1 + slope . normal).
    std::vector<Eigen::Vector3f> slope;
    std::vector<Eigen::Vector3f> lamps;  // irradiance vector: sum of strength * direction to the
                                         // lamp
    Eigen::Vector3f lamp_color = Eigen::Vector3f::Ones();
    /// By cell: the share of `lamps` that comes from the scene's own lamps, which have another
    /// colour; empty: none.
    std::vector<float> scene_lamp_share;
    Eigen::Vector3f scene_lamp_color = Eigen::Vector3f::Ones();
    float dimmed = 1.0F;    // dimming of sky, sun and emission relative to the rig; see balanced()
    float exposure = 1.0F;  // a white surface in average light becomes light grey (0.62)
    // Factors of visible emission, besides `dimmed`: of objects that do not show the outside, and
    // of those that do (see showsOutside()).
    float lamps_shine = 1.0F;
    float outside_shines = 1.0F;
    Eigen::Vector3f backdrop_factor = Eigen::Vector3f::Ones();  // factor of the visible sky
    float backdrop_grey = 0.0F;                                 // see skyBackdrop()
    SunLight sun;  // its direct light is in no grid; its reflected light is in `ambient`

    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * cells[1] + y) * cells[0] + x;
    }
};

/// Clamps a slope's length to 0.75. Light from one half space has a slope of 1; in cells half
/// outside a window this would turn one side of thin objects black.
[[nodiscard]] Eigen::Vector3f limited(const Eigen::Vector3f& slope);

/// Copies the rig's strengths and colours that are not part of the grids.
void setStrengths(const LightRig& rig, LightVolume& volume);

/// The rig with sky, sun and emission dimmed as in the volume. Files give emission in any unit, and
/// a house without a roof would get daylight only, so both are dimmed until they no longer drown
/// the lamps.
[[nodiscard]] LightRig balanced(LightRig rig, const LightVolume& volume);

/// Bakes the light volume by ray casting on all threads. The result does not depend on the number
/// of threads. Empty if the job was cancelled.
[[nodiscard]] LightVolume bakeLightVolume(const Scene& scene, const RayCaster& rays,
                                          const LightRig& rig, const LightVolumeParams& params = {},
                                          const JobContext& job = {});

}  // namespace dollytrack::render
