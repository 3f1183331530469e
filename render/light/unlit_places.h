#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/light/light_rig.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace dollytrack::render {

/// Lamps for the storeys, closed rooms and large dark parts of rooms that these lamps leave unlit:
/// one box may hold several storeys, and rooms between two lamps. A place counts if a person can
/// stand there below a ceiling and the ceiling is within one of the boxes. Their number is bounded.
[[nodiscard]] std::vector<Lamp> lampsForUnlitPlaces(const Scene& scene, const RayCaster& rays,
                                                    std::span<const Eigen::AlignedBox3d> rooms,
                                                    std::span<const Lamp> lamps);

}  // namespace dollytrack::render
