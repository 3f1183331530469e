#pragma once

#include "render/light/light_volume.h"

#include <Eigen/Core>

namespace dollytrack::render {

// CPU versions of the light volume lookups in light.frag.

/// Irradiance of a surface with this normal, without direct sunlight. World frame, m. Linear, in
/// units of LightVolume::ambient.
[[nodiscard]] Eigen::Vector3f irradianceAt(const LightVolume& light,
                                           const Eigen::Vector3d& position,
                                           const Eigen::Vector3d& normal);

/// Blurred radiance that arrives at a position from the direction `way`, in the same units (times
/// pi).
[[nodiscard]] Eigen::Vector3f lightFrom(const LightVolume& light, const Eigen::Vector3d& position,
                                        const Eigen::Vector3d& way);

}  // namespace dollytrack::render
