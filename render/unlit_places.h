#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/light_rig.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace dollytrack::render {

/// Lamps for the rooms and storeys that none of these lamps is in: boxes of rooms may hold several
/// storeys, and closed rooms between two lamps. Looked for within the boxes, wherever a person
/// could stand below a ceiling; what is open to a lamp just below its own ceiling is lit by it.
[[nodiscard]] std::vector<Lamp> lampsForUnlitPlaces(const Scene& scene, const RayCaster& rays,
                                                    std::span<const Eigen::AlignedBox3d> rooms,
                                                    std::span<const Lamp> lamps);

}  // namespace dollytrack::render
