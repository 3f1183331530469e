#pragma once

#include "render/light/light_volume.h"

#include <Eigen/Core>

namespace dollytrack::render {

// What light.frag reads off a light volume, on the processor.

/// Irradiance of a surface, without the sun's, that faces `normal`; world, m. Linear, in units of
/// LightVolume::ambient.
[[nodiscard]] Eigen::Vector3f irradianceAt(const LightVolume& light,
                                           const Eigen::Vector3d& position,
                                           const Eigen::Vector3d& normal);

/// The room's blurred light that comes to a place along -way, in the same units.
[[nodiscard]] Eigen::Vector3f lightFrom(const LightVolume& light, const Eigen::Vector3d& position,
                                        const Eigen::Vector3d& way);

}  // namespace dollytrack::render
