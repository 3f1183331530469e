#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace dollytrack {

/// A level on which people walk. Heights in the world, m.
struct FloorLevel {
    double underside_m = 0.0;  // of its slab, as far as that has one
    double top_m = 0.0;
};

/// The floors one above the other, rising: large level surfaces labelled as floors.
[[nodiscard]] std::vector<FloorLevel> labelledFloors(const Scene& scene);

/// The same from all structure but ceilings, where a room's air is above: many files have floors
/// and walls in one piece. `rooms` are boxes of places where a camera can be.
[[nodiscard]] std::vector<FloorLevel> floorsBelow(const Scene& scene,
                                                  std::span<const Eigen::AlignedBox3d> rooms);

/// The lowest large level surface of structure, whatever its label; the scene's lowest place where
/// there is none.
[[nodiscard]] double lowestFloor(const Scene& scene);

}  // namespace dollytrack
