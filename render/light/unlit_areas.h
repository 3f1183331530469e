#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/light/light_rig.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace dollytrack::render {

/// Adds lamps for storeys, closed rooms and large dark parts of rooms that `lamps` leave unlit: one
/// room box may contain several storeys or rooms between lamps. A position counts if a person can
/// stand there below a ceiling and the ceiling lies within a room box. At most 64 lamps are added.
[[nodiscard]] std::vector<Lamp> lampsForUnlitAreas(const Scene& scene, const RayCaster& rays,
                                                   std::span<const Eigen::AlignedBox3d> rooms,
                                                   std::span<const Lamp> lamps);

}  // namespace dollytrack::render
